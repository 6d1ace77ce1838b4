// Pictures are drawn by Python, but no Python of the current folder nor of the user's environment takes part in it.
#include <gtest/gtest.h>

#include "run_program.h"

namespace rheocyte::test::current_folder_test {
namespace {

namespace fs = std::filesystem;

class CurrentFolder : public testing::Test {
 protected:
  CurrentFolder() {
    const std::string trap = "open('" + sprung().string() + "', 'a').write(__name__ + '\\n')\n";
    for (const std::string module : {"json", "numpy", "matplotlib", "signal", "sitecustomize", "usercustomize"})
      write_file(folder_.path() / (module + ".py"), trap);
    fs::create_directory(folder_.path() / "rheocyte");
    write_file(folder_.path() / "rheocyte/__init__.py", trap);
    write_file(folder_.path() / "matplotlibrc", "text.usetex: True\nfont.size: nonsense\n");
  }

  fs::path sprung() const { return folder_.path() / "sprung"; }

  Ended run_here(const std::vector<std::string>& arguments) const {
    Command command{arguments};
    command.folder = folder_.path();
    const auto here = folder_.path().string();
    command.environment = {{"PYTHONPATH", here},
                           {"PYTHONSTARTUP", here + "/json.py"},
                           {"PYTHONHOME", here},
                           {"MATPLOTLIBRC", here},
                           {"MPLBACKEND", "nonsense"}};
    return run(command);
  }

  TemporaryFolder folder_;
};

TEST_F(CurrentFolder, IsNotExecutedBySolve) {
  const auto ended = run_here({FAILING_RHEOCYTE, "solve", std::string(EXAMPLES) + "/paper-cell.toml", "-o", "result"});
  EXPECT_EQ(ended.exit_code, 0) << ended.err;
  // This solver writes no fields: the drawing program itself has come to its end.
  EXPECT_NE(ended.err.find("fields.vtu is damaged"), std::string::npos) << ended.err;
  EXPECT_FALSE(fs::exists(sprung())) << content_of(sprung());
}

TEST_F(CurrentFolder, IsNotExecutedByPictureAndFigure) {
  fs::create_directory(folder_.path() / "result");
  write_file(folder_.path() / "result/result.json", "{}");
  const auto picture = run_here({RHEOCYTE, "picture", "result"});
  EXPECT_NE(picture.err.find("is not a result of rheocyte"), std::string::npos) << picture.err;
  expect_sentence(run_here({RHEOCYTE, "figure", "0"}), "available are ");
  EXPECT_FALSE(fs::exists(sprung())) << content_of(sprung());
}

}  // namespace
}  // namespace rheocyte::test::current_folder_test
