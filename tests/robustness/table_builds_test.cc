// Programs of different builds at one table: one that wants other branches, or reads other records, is refused by one
// sentence; nothing hangs and nothing is mixed.
#include <gtest/gtest.h>

#include <future>

#include "table_command.h"

namespace rheocyte::test::table_builds_test {
namespace {

class TableOfSeveralBuilds : public TableCommand {
 protected:
  /// As the program of a build with other words for its records leaves it.
  void make_foreign(const fs::path& record) const {
    std::string bytes = content_of(record);
    const auto format = bytes.find("format") + 7;  // behind the name and the length of the text
    ASSERT_EQ(bytes.at(format), '2');
    bytes[format] = '0';
    write_file(record, bytes);
  }

  std::string mark(const fs::path& table) const { return content_of(table / "begun-by.txt"); }
  void write_mark(const fs::path& table, const std::string& text) const { write_file(table / "begun-by.txt", text); }
};

TEST_F(TableOfSeveralBuilds, RecordsOfAnotherFormatAreNamedBeforeAnythingIsComputed) {
  // Two of four cannot be read, one is missing: it stays missing until the two are gone.
  copy_made(table("t"));
  const auto before = finished(table("t"));
  const fs::path records = table("t") / "branches";
  make_foreign(records / "radius-0001.cbor");
  make_foreign(records / "radius-0003.cbor");
  fs::remove(records / "radius-0000.cbor");
  const Ended ended = make(table("t"));
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  for (const std::string words : {"radius-0001.cbor", "in format \"0\" and not 2", "There are 2 of that kind"})
    EXPECT_NE(ended.err.find(words), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(records / "radius-0000.cbor"));
  fs::remove(records / "radius-0001.cbor");
  fs::remove(records / "radius-0003.cbor");
  ASSERT_EQ(make(table("t")).exit_code, 0);
  EXPECT_TRUE(finished(table("t")) == before);
}

TEST_F(TableOfSeveralBuilds, ARecordOfAnotherCellIsNamed) {
  // Whole and of the same spec, but not the radius of its place.
  copy_made(table("t"));
  const fs::path records = table("t") / "branches";
  fs::copy(records / "radius-0002.cbor", records / "radius-0001.cbor", fs::copy_options::overwrite_existing);
  expect_sentence(make(table("t")), "radius-0001.cbor: this record holds another cell");
}

TEST_F(TableOfSeveralBuilds, ARankThatWantsOtherBranchesIsRefused) {
  // The same version and the same spec, but another list of branches: nothing in the folder changes.
  copy_made(table("t"));
  std::string other = mark(table("t"));
  other[other.size() - 2] = other[other.size() - 2] == '0' ? '1' : '0';
  write_mark(table("t"), other);
  const auto before = finished(table("t"));
  expect_sentence(make(table("t"), {{"SLURM_PROCID", "1"}, {"SLURM_NTASKS", "2"}}), "program of the first start");
  EXPECT_TRUE(finished(table("t")) == before);
}

TEST_F(TableOfSeveralBuilds, AFolderOfAnEarlierBuildGoesOnAndIsMarked) {
  // Earlier builds marked folders with version and spec alone. Its records serve; from then on it is one of this build.
  copy_made(table("t"));
  const auto before = finished(table("t"));
  const std::string own = mark(table("t"));
  write_mark(table("t"), own.substr(0, own.find(", branches")) + "\n");
  fs::remove(table("t") / "branches" / "radius-0002.cbor");
  const Ended ended = make(table("t"));
  ASSERT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_TRUE(finished(table("t")) == before);
}

TEST_F(TableOfSeveralBuilds, RanksThatStartTogetherMakeOneTable) {
  // Each may be the first in the empty folder; none takes the others' files for somebody's.
  copy_made(table("one"));
  std::vector<std::future<Ended>> ranks;
  for (int rank = 0; rank < 4; ++rank)
    ranks.push_back(std::async(std::launch::async, [this, rank] {
      return make(table("four"), {{"PMI_RANK", std::to_string(rank)}, {"PMI_SIZE", "4"}});
    }));
  for (auto& rank : ranks) {
    const Ended ended = rank.get();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
  }
  EXPECT_EQ(differences(table("four"), table("one")), std::vector<std::string>());
}

TEST_F(TableOfSeveralBuilds, AnInterruptedBeginningGoesOn) {
  // Killed between the claim and the mark: these files are the program's own.
  fs::create_directories(table("t") / "branches");
  write_file(table("t") / "begun-by.claim", "");
  write_file(table("t") / "spec.toml", "[chan");
  const Ended ended = make(table("t"));
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  EXPECT_FALSE(fs::exists(table("t") / "begun-by.claim"));
}

}  // namespace
}  // namespace rheocyte::test::table_builds_test
