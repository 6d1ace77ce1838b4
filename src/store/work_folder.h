// A folder in which several processes, on this machine or on others, do the pieces of one work: what is requested, who
// works on which piece, and a record of each that is done.
#pragma once
#include <filesystem>
#include <string>
#include <string_view>

#include "case/to_path.h"
#include "store/claim.h"

namespace rheocyte {

/// Every process that takes part must want the same records.
struct WantedWork {
  std::string spec;          ///< content of spec.toml
  std::string mark;          ///< one line: which records are requested
  std::string earlier_mark;  ///< of builds before; its records are read before it is replaced (take_over)
  std::string pieces;        ///< name of the folder of records and claims
};

class WorkFolder {
 public:
  /// Makes the folder, or goes on in one that was begun for the same work; several processes may come at once.
  /// UserError if it belongs to another one, holds other files, or cannot be written.
  WorkFolder(std::filesystem::path folder, WantedWork wanted);

  const std::filesystem::path& path() const { return folder_; }
  /// The file of a record, for sentences.
  std::filesystem::path record(const std::string& name) const { return pieces() / to_path(name); }

  /// Nothing while another process holds it. UserError if the file system knows no locks.
  Claim claim(const std::string& piece) const;
  bool has(const std::string& record) const;
  /// Empty if there is none.
  std::string content(const std::string& record) const;
  /// Writes a record whole or not at all. UserError.
  void keep(const std::string& record, std::string_view content) const;

  /// Programs that want other records are refused from now on, also where an earlier build has begun.
  void take_over() const;
  /// A file beside the spec, whole or not at all. UserError.
  void publish(const std::string& name, std::string_view content) const;
  /// Removes claims, and what interrupted writes of this machine have left.
  void tidy() const;

 private:
  bool is_begun() const;
  bool holds_the_spec() const;
  void begin() const;

  std::filesystem::path pieces() const { return folder_ / to_path(wanted_.pieces); }

  std::filesystem::path folder_;
  WantedWork wanted_;
};

}  // namespace rheocyte
