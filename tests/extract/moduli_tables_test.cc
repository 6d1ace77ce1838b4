// In which liquid a combined table is used.
#include "extract/moduli_tables.h"

#include <gtest/gtest.h>

#include "table/origin_record.h"
#include "table/table_metadata.h"

namespace rheocyte::moduli_tables_test {
namespace {

TEST(ModuliTables, InAThinningMediumTheStatesAreChangedToIt) {
  const ModuliTables tables{ModuliOptions{}};
  EXPECT_EQ(tables.name(), "HC-2D-NH-26");
  const ModuliTable& cellcarrier = tables.seen_in(Section::tube, 0.655, "");
  EXPECT_EQ(cellcarrier.simulated.exponent, 0.6548);
  EXPECT_EQ(&tables.seen_in(Section::tube, 0.6548, ""), &cellcarrier) << "once for all recordings";
  EXPECT_EQ(tables.seen_in(Section::tube, 0.5149, "").simulated.exponent, 0.5149);
  EXPECT_EQ(cellcarrier.content.branches.size(), tables.computed().content.branches.size());
}

TEST(ModuliTables, InANewtonianMediumTheyAreThoseThatWereComputed) {
  const ModuliTables tables{ModuliOptions{}};
  EXPECT_EQ(&tables.seen_in(Section::tube, 1, ""), &tables.computed());
}

TEST(ModuliTables, TheLawOfTheSquareSectionContainsTheLiquid) {
  const ModuliTables tables{ModuliOptions{}};
  EXPECT_EQ(&tables.seen_in(Section::square, 0.6548, ""), &tables.computed());
}

TEST(ModuliTables, VirtualCellsOfTheTableAreInItsOwnLiquid) {
  const ModuliTables tables{ModuliOptions{}};
  const Case& base = tables.computed().content.spec.base;
  EXPECT_EQ(&tables.seen_in(Section::tube, 0.6548, cells_in_words(model_text(base), base.channel.section)),
            &tables.computed());
}

}  // namespace
}  // namespace rheocyte::moduli_tables_test
