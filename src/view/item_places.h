// What the user has named on the command line, as the view lists it.
#pragma once
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace rheocyte {

enum class ItemKind { recording, case_file, result, table, combined };
std::string_view name_of(ItemKind);

struct ItemPlace {
  ItemKind kind = ItemKind::recording;
  std::filesystem::path path;  ///< absolute
  std::string name = {};       ///< the file's, behind those of the folders below the one that was given
  std::string error = {};      ///< why there is nothing to be opened; empty otherwise
};

enum class Folders {
  searched,    ///< for recordings, results and tables
  as_they_are  ///< only those that are a result or a table themselves: a session of somebody else names what it likes
};

/// Files, each as what its name says (.toml: a case; .cbor, .txt: a table; else a recording), folders of results and
/// of tables (combined: of cells with bulk and cortex), and what other folders hold of recordings, results and tables,
/// sorted by name and without companions of recordings that are there. Each once, in the order given. What is missing
/// or empty stays, with a sentence.
std::vector<ItemPlace> item_places(std::span<const std::filesystem::path> paths, Folders = Folders::searched);

}  // namespace rheocyte
