#include "state/outcome.h"

#include <gtest/gtest.h>

#include <set>

namespace rheocyte::outcome_test {
namespace {

constexpr std::array statuses = {Status::not_started,     Status::converged,        Status::iteration_limit,
                                 Status::mesh_folded,     Status::surface_unstable, Status::branch_ended,
                                 Status::singular_matrix, Status::not_finite,       Status::accuracy_not_reached,
                                 Status::stopped,         Status::limit_point};

TEST(Outcome, ItStartsAsNoSuccess) {
  // Success has to be said, never assumed.
  EXPECT_EQ(Outcome{}.status, Status::not_started);
}

TEST(Outcome, EveryStatusHasItsOwnName) {
  // Names are stable and distinct.
  std::set<std::string> names;
  for (const Status status : statuses) names.insert(name(status));
  EXPECT_EQ(names.size(), statuses.size());
  EXPECT_FALSE(names.contains("unknown"));
  EXPECT_STREQ(name(Status::surface_unstable), "surface-unstable");
}

TEST(Outcome, NoStateIsConvergedThatIsUnstableOrNotAccurate) {
  // The one check of all final states; a margin comes first, an unknown error (NaN) is left to those who know why, and
  // how else a way ended is not changed.
  const auto status = [](double margin, double error, double wanted) {
    return judged(Status::converged, {margin, error, wanted});
  };
  EXPECT_EQ(status(0.2, 1e-3, 1e-3), Status::converged);
  EXPECT_EQ(status(0, 1e-3, HUGE_VAL), Status::converged);
  EXPECT_EQ(status(-0.071, 1e-3, 1e-2), Status::surface_unstable);
  EXPECT_EQ(status(-0.09, 0.18, 0.01), Status::surface_unstable);
  EXPECT_EQ(status(0.2, 0.18, 0.01), Status::accuracy_not_reached);
  EXPECT_EQ(status(0.2, HUGE_VAL, 0.01), Status::accuracy_not_reached);
  EXPECT_EQ(status(0.2, std::nan(""), 0.01), Status::converged);
  EXPECT_EQ(judged(Status::accuracy_not_reached, {-0.1, 0.5, 0.1}), Status::surface_unstable);
  for (const Status other : {Status::stopped, Status::branch_ended, Status::not_finite})
    EXPECT_EQ(judged(other, {-0.1, 0.5, 0.1}), other) << name(other);
}

TEST(Outcome, AdviceCanBeFollowed) {
  // No accuracy is advised that the key does not take, or that is below the error by rounding; no end of a branch lies
  // "at 1 times the wanted moduli", and none is advised below them.
  const auto inaccurate = [](double error) {
    return explanation({Status::accuracy_not_reached, "", 1}, {.deformation = 0.03, .estimated_error = error});
  };
  EXPECT_NE(inaccurate(1.04e-3).find("numerics.accuracy = 1.1e-03 or more"), std::string::npos) << inaccurate(1.04e-3);
  EXPECT_NE(inaccurate(0.0999).find("numerics.accuracy = 1.0e-01 or more"), std::string::npos) << inaccurate(0.0999);
  for (const double error : {0.11, 6.2e5}) {
    EXPECT_EQ(inaccurate(error).find("numerics.accuracy"), std::string::npos) << inaccurate(error);
    EXPECT_NE(inaccurate(error).find("raise the moduli"), std::string::npos) << inaccurate(error);
  }
  for (const Status status : {Status::surface_unstable, Status::branch_ended, Status::iteration_limit})
    for (const double reached : {1.0, 0.99999}) {
      const std::string sentence = explanation({status, "", reached}, {.deformation = 0.05, .known_end = 0.98});
      EXPECT_EQ(sentence.find(" 1 times"), std::string::npos) << sentence;
      EXPECT_EQ(sentence.find("0.98"), std::string::npos) << sentence;
    }
}

TEST(Outcome, AShapeBeyondItsLimitSaysByHowMuch) {
  const std::string sentence = explanation({Status::surface_unstable, "", 1},
                                           {.deformation = 0.05, .stability_margin = -0.071, .can_bend = false});
  EXPECT_NE(sentence.find("stability_margin -0.071"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("raise the moduli"), std::string::npos) << sentence;
}

TEST(Outcome, EveryStatusHasASentence) {
  // Whatever was reached; only success speaks of a shape that was found without reserve.
  for (const Status status : statuses) {
    for (const double reached : {0.0, 0.4, 1.0}) {
      const std::string sentence =
          explanation({status, "", reached}, {.deformation = 0.05, .estimated_error = 1e-3, .wanted_error = 1e-3});
      EXPECT_EQ(sentence.back(), '.') << name(status);
      EXPECT_EQ(sentence == "The stationary shape was found.", status == Status::converged);
    }
  }
}

TEST(Outcome, ADeformationBelowTheFloorIsToldSo) {
  // What is known of it is absolute.
  const Outcome converged{Status::converged, "", 1};
  const std::string sentence =
      explanation(converged, {.deformation = 1e-13, .deformation_floor = 1e-8, .wanted_error = 1e-4});
  EXPECT_NE(sentence.find("so small that it is known within 1e-12"), std::string::npos) << sentence;
  EXPECT_NE(sentence.find("not within the requested 1.0e-04"), std::string::npos) << sentence;
}

TEST(Outcome, TheEndOfTheBranchIsToldInModuliAndDeformation) {
  // 0.4 of the compliance is 2.5 times the modulus.
  for (const Status status : {Status::surface_unstable, Status::branch_ended, Status::mesh_folded}) {
    const std::string sentence = explanation({status, "", 0.4}, {.deformation = 0.0512});
    EXPECT_NE(sentence.find("2.5 times the requested moduli"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("0.0512"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("raise the moduli"), std::string::npos) << sentence;
  }
}

TEST(Outcome, ALimitPointIsToldByTheModuliAtWhichTheBranchTurns) {
  // The last state before it is another one; an end without evidence of a fold is not called one.
  const std::string turns = explanation({Status::limit_point, "", 0.4}, {.deformation = 0.0512, .turning = 2.45});
  EXPECT_NE(turns.find("turns back at 2.45 times the requested moduli"), std::string::npos) << turns;
  EXPECT_NE(turns.find("2.5 times the requested moduli (deformation 0.0512)"), std::string::npos) << turns;
  const std::string ends = explanation({Status::branch_ended, "", 0.4}, {.deformation = 0.0512});
  EXPECT_EQ(ends.find("turns"), std::string::npos) << ends;
  EXPECT_NE(ends.find("not followed beyond"), std::string::npos) << ends;
}

TEST(Outcome, AnUnstableSurfaceIsOfferedWhatCouldHoldIt) {
  // By the names of the keys; a surface that is held already is not.
  const Outcome unstable{Status::surface_unstable, "", 0.4};
  for (const char* key : {"cell.cortex.bending_kBT", "cell.cortex.tension_mN_per_m"}) {
    EXPECT_NE(explanation(unstable, {.deformation = 0.05, .surface = SurfaceKind::bare}).find(key), std::string::npos);
    EXPECT_NE(explanation(unstable, {.deformation = 0.05, .surface = SurfaceKind::membrane}).find(key),
              std::string::npos);
    EXPECT_EQ(explanation(unstable, {.deformation = 0.05, .surface = SurfaceKind::held}).find(key), std::string::npos);
  }
  EXPECT_NE(explanation(unstable, {.deformation = 0.05, .surface = SurfaceKind::membrane}).find("cortex"),
            std::string::npos);
}

TEST(Outcome, ACollapsedCortexIsToldByWhereItLostItsResistance) {
  const LastState last{.deformation = 0.05, .surface = SurfaceKind::held, .weak_point = WeakPoint{0.613, 0.854, -0.95}};
  for (const double reached : {0.4, 1.0}) {
    const std::string sentence = explanation({Status::surface_unstable, "", reached}, last);
    for (const char* part :
         {"resistance to compression", "0.613 along", "0.854 around", "0.95 r0 behind", "neo-hookean"})
      EXPECT_NE(sentence.find(part), std::string::npos) << sentence;
    EXPECT_EQ(sentence.find("wrinkle"), std::string::npos) << sentence;
  }
}

TEST(Outcome, ACellOffTheAxisIsNotOfferedTheBendingStiffnessThatItCannotHave) {
  for (const double reached : {0.0, 0.4}) {
    const std::string sentence =
        explanation({Status::surface_unstable, "", reached}, {.surface = SurfaceKind::bare, .can_bend = false});
    EXPECT_EQ(sentence.find("bending"), std::string::npos) << sentence;
    EXPECT_NE(sentence.find("cell.cortex.tension_mN_per_m"), std::string::npos) << sentence;
  }
}

TEST(Outcome, AnEndThatWasSeenOnCoarseMeshesSaysSo) {
  const Outcome outcome{.status = Status::surface_unstable, .message = {}, .reached = 0.8};
  const std::string known = explanation(outcome, {.deformation = 0.05, .is_coarse = true, .known_end = 1.165});
  EXPECT_NE(known.find("ends at 1.165 times the requested moduli (the last state kept has 1.25"), std::string::npos)
      << known;
  EXPECT_EQ(known.find("finer meshes"), std::string::npos);
  const std::string unknown = explanation(outcome, {.deformation = 0.05, .is_coarse = true});
  EXPECT_NE(
      unknown.find("ends at 1.25 times the requested moduli (deformation 0.0500), on finer meshes up to a fifth lower"),
      std::string::npos)
      << unknown;
}

}  // namespace
}  // namespace rheocyte::outcome_test
