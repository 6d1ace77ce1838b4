// The project's reference data: values of the field's programs and recordings. They are not part of the repository;
// tests that need them are skipped where they are absent, and quote single values that are always compared.
#pragma once
#include <gtest/gtest.h>

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace rheocyte::test {

/// The folder, set when the build was configured (RHEOCYTE_REFERENCE); perhaps it does not exist.
std::filesystem::path reference_folder();

/// A table of texts and numbers: columns by name, all equally long.
struct CsvTable {
  std::map<std::string, std::vector<std::string>> columns;
  std::size_t rows() const { return columns.empty() ? 0 : columns.begin()->second.size(); }
  const std::string& text(const std::string& column, std::size_t row) const { return columns.at(column).at(row); }
  double number(const std::string& column, std::size_t row) const;  ///< "nan" is one
};

CsvTable read_csv(const std::filesystem::path& file);

}  // namespace rheocyte::test

/// Skips the test with a message if a file of the reference folder is absent.
#define RHEOCYTE_NEED_REFERENCE(name)                                             \
  do {                                                                            \
    if (!std::filesystem::exists(rheocyte::test::reference_folder() / (name)))    \
      GTEST_SKIP() << "the reference folder has no " << (name)                    \
                   << "; configure with -DRHEOCYTE_REFERENCE=<folder> to use it"; \
  } while (false)
