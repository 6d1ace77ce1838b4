// The deal.II side of the mesh; included by this floor's sources only.
#pragma once
#include <deal.II/grid/tria.h>

#include "fem/channel_mesh.h"

namespace rheocyte {

struct ChannelMesh::Topology {
  dealii::Triangulation<2> triangulation;
};

}  // namespace rheocyte
