// The folder of a table while it is computed: its spec, one record per branch, and who works on which. Every process
// that takes part, on this machine or another, must want the same records; the folder's mark says which ones.
#pragma once
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A claim on one branch; the system gives it up when the process ends, however it ends.
class Claim {
 public:
  Claim() = default;
  explicit Claim(int descriptor) : descriptor_(descriptor) {}
  Claim(Claim&& other) noexcept : descriptor_(other.descriptor_) { other.descriptor_ = -1; }
  Claim& operator=(Claim&&) = delete;
  ~Claim();
  explicit operator bool() const { return descriptor_ >= 0; }

 private:
  int descriptor_ = -1;
};

class TableFolder {
 public:
  /// Makes the folder, or goes on in one that was begun with the same spec by a program that wants the same records;
  /// several processes may come at once. UserError if it belongs to another one, holds other files, or cannot be
  /// written.
  TableFolder(const std::filesystem::path& folder, const TableSpec&);

  const TableSpec& spec() const { return spec_; }
  const std::filesystem::path& path() const { return folder_; }

  int branches() const { return int(places_.size()); }
  const BranchPlace& place(int i) const { return places_[i]; }
  /// Whether the branches beyond the ends of the bare ones are wanted, too.
  bool wants_held() const { return spec_.bending_beyond_kBT > 0; }

  /// Before work goes on: reads every record that is there. UserError naming the first one that cannot be used, and how
  /// many there are; otherwise programs that want other records are refused from now on.
  void take_over() const;

  bool is_done(int i) const;
  int done() const;
  /// Nothing while another process holds it. UserError if the file system knows no locks.
  Claim claim(int i) const;
  /// The first branch that is missing while no process holds it.
  std::optional<int> first_free() const;
  /// The file that branch i still lacks.
  std::filesystem::path missing_record(int i) const { return record(i, has(i, false)); }
  /// Writes the record whole or not at all.
  void keep(int i, const SampledBranch&, bool held) const;
  bool has(int i, bool held) const;
  /// UserError naming the file if it is damaged or holds another cell than that of the place.
  SampledBranch read(int i, bool held) const;
  /// All records, in the order of the places. UserError naming the file if one is damaged.
  std::vector<SampledBranch> read_all() const;
  /// Removes what claims and interrupted writes have left.
  void tidy() const;
  /// A finished file beside the spec, whole or not at all.
  void publish(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path record(int i, bool held) const;
  std::string layout() const;
  bool is_begun() const;
  void begin() const;

  std::filesystem::path folder_;
  TableSpec spec_;
  std::string hash_;
  std::vector<BranchPlace> places_;
  std::string mark_;  ///< what the mark says of a folder that this program has begun
};

}  // namespace rheocyte
