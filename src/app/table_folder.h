// The folder of a table while it is computed: its spec, one record per branch, and who works on which.
#pragma once
#include <filesystem>
#include <string>
#include <vector>

#include "table/branch.h"
#include "table/table_spec.h"

namespace rheocyte {

/// A claim on one radius; the system gives it up when the process ends, however it ends.
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
  /// Makes the folder, or goes on in one that was begun with the same spec by the same version. UserError if it
  /// belongs to another one, holds other files, or cannot be written.
  TableFolder(const std::filesystem::path& folder, const TableSpec&);

  const TableSpec& spec() const { return spec_; }
  const std::filesystem::path& path() const { return folder_; }

  int radii() const { return int(radii_um_.size()); }
  double radius_um(int i) const { return radii_um_[i]; }
  /// Whether the branches beyond the ends of the bare ones are wanted, too.
  bool wants_held() const { return spec_.bending_beyond_kBT > 0; }

  bool is_done(int i) const;
  int done() const;
  Claim claim(int i) const;
  /// Writes the record whole or not at all.
  void keep(int i, const SampledBranch&, bool held) const;
  bool has(int i, bool held) const;
  SampledBranch read(int i, bool held) const;
  /// All records, radius by radius. UserError naming the file if one is damaged.
  std::vector<SampledBranch> read_all() const;
  /// Removes what claims and interrupted writes have left.
  void tidy() const;
  /// A finished file beside the spec, whole or not at all.
  void publish(const std::string& name, std::string_view content) const;

 private:
  std::filesystem::path record(int i, bool held) const;
  void begin() const;

  std::filesystem::path folder_;
  TableSpec spec_;
  std::string hash_;
  std::vector<double> radii_um_;
};

}  // namespace rheocyte
