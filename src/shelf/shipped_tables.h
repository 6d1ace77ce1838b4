// The tables that come with the program.
#pragma once
#include <filesystem>
#include <map>
#include <string>

namespace rheocyte {

/// Files grid_<identifier>.cbor by identifier, in this folder; if it is empty in share/rheocyte/tables beside an
/// installed program or in the folder data of the sources; RHEOCYTE_TABLES in the environment names another folder.
std::map<std::string, std::filesystem::path> shipped_tables(const std::filesystem::path& folder = {});

/// Also the files elongated_<identifier>.cbor of elongated cells.
std::map<std::string, std::filesystem::path> shipped_elongated_tables(const std::filesystem::path& folder = {});
/// Also the files combined_<identifier>.cbor of cells with bulk and cortex.
std::map<std::string, std::filesystem::path> shipped_combined_tables(const std::filesystem::path& folder = {});
/// Also the files dynamic_<identifier>.cbor of cells on their way.
std::map<std::string, std::filesystem::path> shipped_dynamic_tables();

/// The requested table, by its place or its identifier, and where none is requested the one that comes with the
/// program: of cells with bulk and cortex, and of cells on their way. UserError if it is missing.
std::filesystem::path combined_table_or_shipped(const std::filesystem::path& wanted);
std::filesystem::path dynamic_table_or_shipped(const std::filesystem::path& wanted);

}  // namespace rheocyte
