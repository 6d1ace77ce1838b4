#include "fem/write_fields.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

#include "fem/tube_fields.h"
#include "small_channel.h"

namespace rheocyte::write_fields_test {
namespace {

using test::SmallChannel;

std::string written(const SmallChannel& channel, const VectorXd& state) {
  const auto path = std::filesystem::path(testing::TempDir()) / "rheocyte_write_fields_test.vtu";
  EXPECT_TRUE(write_fields(TubeFields(channel.space, {{}, {BulkLaw::neo_hookean, 12}}, state, {}), path.string()));
  std::stringstream text;
  text << std::ifstream(path).rdbuf();
  std::filesystem::remove(path);
  return text.str();
}

TEST(WriteFields, TheFileHoldsEveryNamedArrayAndEveryElement) {
  // ParaView and the picture look for these names; one high-order cell per element.
  SmallChannel channel(0.6);
  const std::string text = written(channel, test::deformed_state(channel.system, {{}, {BulkLaw::neo_hookean, 12}}));
  EXPECT_NE(text.find("type=\"UnstructuredGrid\""), std::string::npos);
  for (const char* name :
       {"velocity", "velocity_relative", "pressure", "stress", "shear_stress", "displacement", "region"}) {
    EXPECT_NE(text.find("Name=\"" + std::string(name) + "\""), std::string::npos) << name;
  }
  const std::string cells = "NumberOfCells=\"" + std::to_string(channel.mesh.elements().size()) + "\"";
  EXPECT_NE(text.find(cells), std::string::npos);
  EXPECT_NE(text.find("</VTKFile>"), std::string::npos);
}

TEST(WriteFields, AFileThatCannotBeWrittenIsReported) {
  // A folder that does not exist, a folder in place of the file, a full disk: false, no exception.
  const SmallChannel channel(0.6);
  const VectorXd state = VectorXd::Zero(channel.space.unknowns());
  for (const char* path : {"/no/such/folder/fields.vtu", "/", "/dev/full"}) {
    bool success = true;
    EXPECT_NO_THROW(success =
                        write_fields(TubeFields(channel.space, {{}, {BulkLaw::neo_hookean, 12}}, state, {}), path))
        << path;
    EXPECT_FALSE(success) << path;
  }
}

}  // namespace
}  // namespace rheocyte::write_fields_test
