// `rheocyte table` as a user starts it, kills it, and starts it again.
#include "table_command.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <random>

namespace rheocyte::test::table_command_test {
namespace {

const std::vector<std::string> none;

/// Starts the command and kills it without warning after some time.
void start_and_kill(const std::vector<std::string>& arguments, int microseconds) {
  std::vector<char*> pointers;
  for (const auto& argument : arguments) pointers.push_back(const_cast<char*>(argument.c_str()));
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t silent;
  ::posix_spawn_file_actions_init(&silent);
  for (const int output : {1, 2}) ::posix_spawn_file_actions_addopen(&silent, output, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  ASSERT_EQ(::posix_spawn(&child, RHEOCYTE, &silent, nullptr, pointers.data(), environ), 0);
  ::posix_spawn_file_actions_destroy(&silent);
  ::usleep(microseconds);
  ::kill(child, SIGKILL);
  ::waitpid(child, nullptr, 0);
}

TEST_F(TableCommand, KilledTwentyTimesItEndsWithTheSameBytes) {
  // 20 kills at random moments; the finished files equal those of an undisturbed run, and nothing else is left.
  const Ended undisturbed = make(table("undisturbed"));
  ASSERT_EQ(undisturbed.exit_code, 0) << undisturbed.err;
  std::mt19937 engine(1);
  const double whole = 1e6 * undisturbed.seconds;
  for (int kill = 0; kill < 20; ++kill)
    start_and_kill(command(table("killed")), std::uniform_int_distribution(0, int(0.6 * whole))(engine));
  const Ended last = make(table("killed"));
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_EQ(differences(table("killed"), table("undisturbed")), none);
  for (const auto& entry : fs::directory_iterator(table("killed") / "branches"))
    EXPECT_EQ(entry.path().extension(), ".cbor") << entry.path();
}

TEST_F(TableCommand, TwoRanksMakeTheTableOfOneProcess) {
  // As under mpirun: both with the same command, distinguished by their environment; rank 0 writes the files.
  copy_made(table("one"));
  const std::map<std::string, std::string> zero{{"OMPI_COMM_WORLD_RANK", "0"}, {"OMPI_COMM_WORLD_SIZE", "2"}},
      one{{"OMPI_COMM_WORLD_RANK", "1"}, {"OMPI_COMM_WORLD_SIZE", "2"}};
  ASSERT_EQ(make(table("two"), one).exit_code, 0);
  EXPECT_FALSE(fs::exists(table("two") / "lut_TEST.txt")) << "not the work of rank 1";
  ASSERT_EQ(make(table("two"), zero).exit_code, 0);
  EXPECT_EQ(differences(table("two"), table("one")), none);
}

TEST_F(TableCommand, TwoRanksShareADynamicTable) {
  // The second one ended with an error, and took the whole job with it.
  write_file(spec(), R"([channel.profile]
x_um = [60.0, 100.0]
R_um = [21.88, 10.94]
[flow]
rate_ul_per_s = 0.04
viscosity_mPas = 15.0
density_kg_per_m3 = 0.0
[cell]
density_kg_per_m3 = 0.0
[time]
degree = 2
accuracy = 1e-3
[dynamic]
identifier = "TEST"
min_radius_um = 6.0
max_radius_um = 8.0
min_young_modulus_kPa = 6.0
max_young_modulus_kPa = 20.0
radii = 2
moduli = 2
times = 2
places = 4
last_um = 60
checks = 0
)");
  const auto rank = [](const char* number) {
    return std::map<std::string, std::string>{{"OMPI_COMM_WORLD_RANK", number}, {"OMPI_COMM_WORLD_SIZE", "2"}};
  };
  const Ended first = make(table("two"), rank("1"));
  ASSERT_EQ(first.exit_code, 0) << first.err;
  EXPECT_FALSE(fs::exists(table("two") / "dynamic_TEST.cbor")) << "not the work of rank 1";
  const Ended last = make(table("two"), rank("0"));
  ASSERT_EQ(last.exit_code, 0) << last.err;
  EXPECT_TRUE(fs::exists(table("two") / "dynamic_TEST.cbor"));
}

TEST_F(TableCommand, AFolderOfAnotherSpecIsLeftAlone) {
  // Named error, and the table in it stays as it was.
  copy_made(table("first"));
  const auto before = finished(table("first"));
  auto other = command(table("first"));
  other.insert(other.end(), {"--set", "table.radii=5"});
  expect_sentence(run({other}), "give another folder with -o");
  EXPECT_TRUE(finished(table("first")) == before);
}

TEST_F(TableCommand, ADamagedRecordIsNamed) {
  // One flipped byte in a branch: exit 2, its file, and the way out; with the file removed the table is finished.
  copy_made(table("t"));
  const auto before = finished(table("t"));
  const fs::path record = table("t") / "branches" / "radius-0002.cbor";
  std::string bytes = content_of(record);
  bytes[bytes.size() / 2] ^= 1;
  write_file(record, bytes);
  const Ended ended = make(table("t"));
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("radius-0002.cbor"), std::string::npos) << ended.err;
  fs::remove(record);
  EXPECT_EQ(make(table("t")).exit_code, 0);
  EXPECT_TRUE(finished(table("t")) == before);
}

TEST_F(TableCommand, ASignalEndsItCleanlyAndItGoesOn) {
  // Ctrl-C: exit 130 and a sentence with the way on.
  Command command_with_signal{command(table("s"))};
  command_with_signal.arguments.insert(command_with_signal.arguments.end(), {"--set", "table.max_deformation=0.05"});
  command_with_signal.arguments.insert(command_with_signal.arguments.end(), {"--set", "table.radii=12"});
  command_with_signal.signal = SIGINT;
  const Ended ended = run(command_with_signal);
  EXPECT_EQ(ended.exit_code, 130) << ended.err;
  EXPECT_NE(ended.err.find("continues from here"), std::string::npos) << ended.err;
}

TEST_F(TableCommand, AFullDiskIsNamed) {
  // Files may not grow beyond 2 kB, as on a full disk.
  Command limited{command(table("full"))};
  limited.max_file_bytes = 2000;
  const Ended ended = run(limited);
  EXPECT_EQ(ended.exit_code, 2) << ended.err;
  EXPECT_NE(ended.err.find("cannot be written"), std::string::npos) << ended.err;
}

TEST_F(TableCommand, OtherFilesAreNotTouched) {
  // A folder with somebody's files is refused.
  fs::create_directory(table("mine"));
  write_file(table("mine") / "thesis.txt", "precious");
  const Ended ended = make(table("mine"));
  EXPECT_EQ(ended.exit_code, 2);
  EXPECT_TRUE(is_one_line(ended.err)) << ended.err;
  EXPECT_EQ(finished(table("mine")).size(), 1u);
}

}  // namespace
}  // namespace rheocyte::test::table_command_test
