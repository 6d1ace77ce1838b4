// What distinguishes one kind of channel from another: the maker of its discretisations, and the numbers of the search
// for its states. Another kind is added by another maker.
#pragma once
#include <memory>
#include <vector>

#include "solve/discrete.h"
#include "solve/ladder.h"
#include "solve/newton.h"
#include "solve/surface_stability.h"

namespace rheocyte {

/// How often a mesh is fitted on a way: a coarse one that is worn again does not see the cell's rim.
enum class Fits { once, ever_again };

/// A resolution of the way along the branch.
struct CoarseWay {
  Resolution resolution;
  /// Of a scout only the last state counts, as a guess for the next way, and only where it went all the way.
  bool is_scout = false;
  Fits fits = Fits::ever_again;
};

/// Degrees on one mesh on which a state is refined.
struct Rungs {
  Subdivision subdivision;
  int first_degree, last_degree;
  bool only_begins = false;       ///< neighbouring degrees agree on this mesh although both are wrong
  bool is_rough_at_rims = false;  ///< the same if the mesh was fitted to a dented cell
  bool goes_on = false;           ///< from the rungs on coarser meshes, rather than from the start
};

struct Geometry {
  std::shared_ptr<Discrete> (*make)(const Problem&, const Resolution&);
  /// Whether the unknowns of two problems with the same laws mean the same at this resolution.
  bool (*is_alike)(const Problem&, const Problem&, const Resolution&);

  std::vector<CoarseWay> ways = {};       ///< ever finer; a way begins where the one before has ended
  NewtonOptions along = {}, across = {};  ///< on a way, and from one to the next
  double min_step_before_refining = 0.03, min_step_at_last = 2e-3;
  /// How much farther than on two coarse resolutions a branch may go on finer ones: relative, and in the change between
  /// these.
  double gain_of_finer = 1, gain_by_change = 0;
  double margin_at_coarse_ends = small_margin;  ///< of the surface's stability, where a search gives up before
  bool ends_late_on_finer = false;              ///< so much later that a coarse end is reported as one
  bool knows_ends = false;                      ///< of bare solids (solve/branch_ends.h)
  bool traces_ends = false;                     ///< where a way ends it is followed round its fold before its mesh is
                                                ///< fitted: fits do not help there, and are dear

  std::vector<Rungs> rungs = {};   ///< coarse to fine
  NewtonOptions fine = {};         ///< on them
  bool begins_with_way = false;    ///< the first rung is the state that the way has ended at, as it is
  bool climbs_anew = false;        ///< where Newton's method does not reach a rung it is reached along the branch
  bool judges_rungs = false;       ///< none is beyond the limit of stability; else the last state alone is judged
  bool adds_lower_change = false;  ///< what changes at a kept state's lower rung, from one problem to the next, is
                                   ///< guessed to change at the next rung, too: where a step there is dear
  ErrorRule errors = {};
};

/// Of a problem's channel.
Geometry solver_geometry(const Problem&);

}  // namespace rheocyte
