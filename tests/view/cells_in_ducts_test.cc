// What the view shows of cells in ducts: both cameras, the whole surface, cells off the axis and on their way.
#include "cell_requests.h"

namespace rheocyte::cells_in_ducts_test {
namespace {

using namespace cell_requests;

class CellsInDucts : public CellRequests {};

/// The first micrometres of a way through a planar funnel.
Json in_funnel(const std::vector<double>& offset_um) {
  const double viscosity_mPas = 15;
  return {{"channel",
           {{"section", "square"},
            {"camera_degree", offset_um[0] == 0 ? 0 : 90},
            {"profile", {{"x_um", {3, 8}}, {"width_um", {30, 20}}}}}},
          {"flow", {{"rate_ul_per_s", 0.04}, {"viscosity_mPas", viscosity_mPas}, {"density_kg_per_m3", 0}}},
          {"cell",
           {{"radius_um", 6},
            {"offset_um", offset_um},
            {"viscosity_mPas", viscosity_mPas},
            {"density_kg_per_m3", 0},
            {"bulk", {{"young_modulus_kPa", 8}}}}},
          {"time", {{"end_um", 1}, {"output_every_um", 1}, {"degree", 2}, {"accuracy", 1e-2}}}};
}

TEST_F(CellsInDucts, InASquareChannelPlaneSurfaceAndContourAreOfOneCell) {
  // The diagonal view, in which walls meet in a corner. Places are 32-bit numbers; those of the surface are 5 degrees
  // apart, so that its widest one is up to 2.5 degrees beside the widest of the contour: 7 um (1 - cos 2.5 degrees).
  Json square = cell(20);
  square["channel"]["section"] = "square";
  square["channel"]["camera"] = "diagonal";
  const Json state = json("/api/state", square, {{"fields", "1"}, {"accuracy", "1e-2"}});
  const Json &fields = state["fields"], &diagonal = state["contours"]["diagonal"];
  EXPECT_DOUBLE_EQ(state["contour"]["x_um"].front().get<double>(), diagonal["x_um"].front().get<double>());
  const auto greatest = [](const std::vector<float>& values, std::size_t first, std::size_t step) {
    float found = values[first];
    for (std::size_t i = first; i < values.size(); i += step) found = std::max(found, values[i]);
    return found;
  };
  const auto xy = floats(fields["xy_um"]), xyz = floats(fields["surface3d"]["xyz_um"]);
  EXPECT_NEAR(greatest(xy, 1, 2), fields["wall"]["r_um"][0].get<double>(), 1e-5);
  EXPECT_NEAR(greatest(xyz, 0, 3), diagonal["x_um"][0].get<double>(), 1e-5);
  const auto side = state["contours"]["side"]["r_um"].get<std::vector<double>>();
  EXPECT_NEAR(greatest(xyz, 1, 3), *std::max_element(side.begin(), side.end()), 7e-3);
  EXPECT_NEAR(greatest(xyz, 1, 3), greatest(xyz, 2, 3), 1e-5);
}

TEST_F(CellsInDucts, ThroughAFunnelIntoASquareBothCamerasSeeTheCell) {
  const Json first = lines_of(post("/api/evolve", in_funnel({0, 0}), {{"fields", "1"}})).front();
  ASSERT_TRUE(first.contains("contours")) << first;
  EXPECT_EQ(first["contours"]["side"]["x_um"].size(), first["contours"]["across"]["x_um"].size());
  EXPECT_TRUE(first["deformation_across"].is_number());
  EXPECT_GE(least(floats(first["fields"]["xy_um"]), 2, 1), -1e-4) << "the upper half";
  EXPECT_FALSE(first["fields"]["surface3d"]["index"].get<std::string>().empty());
  const std::vector<double> x_um = first["wall"]["x_um"], r_um = first["wall"]["r_um"];
  ASSERT_EQ(x_um.size(), r_um.size());
  EXPECT_NEAR(x_um.front(), -x_um.back(), 1e-9) << "round the cell";
  // But for the way of the barycentre from the middle of the mesh.
  EXPECT_NEAR(x_um.front(), least(floats(first["fields"]["xy_um"]), 2, 0), 1) << "as far as the fields";
  EXPECT_TRUE(std::ranges::is_sorted(r_um, std::greater()));
  EXPECT_LT(r_um.back(), r_um.front());
}

TEST_F(CellsInDucts, ACellOffTheAxisIsShownInThePlaneOfItsOffset) {
  const Json first = lines_of(post("/api/evolve", in_funnel({3, 0}), {{"fields", "1"}})).front();
  const std::vector<double> r_um = first["contour"]["r_um"];
  EXPECT_NEAR(0.5 * (std::ranges::max(r_um) + std::ranges::min(r_um)), 3, 0.01);
  EXPECT_NEAR(first["offset_um"].get<double>(), 3, 0.01);
  const std::vector<float> points = floats(first["fields"]["xy_um"]);
  EXPECT_LT(least(points, 2, 1), -14) << "both sides of the axis";
  const std::vector<float> surface = floats(first["fields"]["surface3d"]["xyz_um"]);
  EXPECT_NEAR(least(surface, 3, 1), 3 - 6, 0.05);
  EXPECT_NEAR(least(surface, 3, 2), -6, 0.05);
}

TEST_F(CellsInDucts, AnOffsetInHeightIsOneInTheWholeSurfaceToo) {
  Json off_axis = cell(40);
  off_axis["channel"]["section"] = "square";
  off_axis["cell"]["radius_um"] = 5;
  off_axis["cell"]["offset_um"] = {0, 2};
  const Json state = json("/api/state", off_axis, {{"fields", "1"}, {"accuracy", "1e-1"}});
  ASSERT_TRUE(state.contains("fields")) << state;
  EXPECT_TRUE(state["hull"].is_null());
  EXPECT_FALSE(state["fields"].contains("surface"));
  const std::vector<float> surface = floats(state["fields"]["surface3d"]["xyz_um"]);
  EXPECT_NEAR(least(surface, 3, 1), -5, 0.1);
  EXPECT_NEAR(least(surface, 3, 2), 2 - 5, 0.3);
}

}  // namespace
}  // namespace rheocyte::cells_in_ducts_test
