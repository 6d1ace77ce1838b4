#include "app/checkpoint.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <optional>
#include <type_traits>

#include "case/read_case.h"
#include "case/scales.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "store/build_info.h"

namespace rheocyte {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "rheocyte checkpoint\n";
constexpr std::size_t version_length = 32;

std::uint64_t checksum(std::string_view bytes) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char letter : bytes) hash = (hash ^ static_cast<unsigned char>(letter)) * 1099511628211u;
  return hash;
}

class Writer {
 public:
  template <class T>
  void number(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class Matrix>
  void matrix(const Matrix& m) {
    number(std::int64_t(m.rows()));
    bytes_.append(reinterpret_cast<const char*>(m.data()), sizeof(double) * std::size_t(m.size()));
  }
  std::string& bytes() { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads nothing beyond the end: `failed` then stays true.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  template <class T>
  T number() {
    T value{};
    take(&value, sizeof value);
    return value;
  }
  template <class Matrix>
  Matrix matrix() {
    const auto rows = std::uint64_t(number<std::int64_t>());
    constexpr std::size_t columns = Matrix::ColsAtCompileTime;
    if (failed || rows > bytes_.size() / (sizeof(double) * columns)) return failed = true, Matrix();
    Matrix m;
    m.resize(static_cast<Eigen::Index>(rows), static_cast<Eigen::Index>(columns));
    take(m.data(), sizeof(double) * columns * rows);
    return m;
  }
  std::size_t count(std::size_t least_size) {
    const auto n = number<std::uint64_t>();
    if (n > bytes_.size() / least_size) failed = true;
    return failed ? 0 : std::size_t(n);
  }
  bool at_end() const { return bytes_.empty() && !failed; }
  bool failed = false;

 private:
  void take(void* target, std::size_t size) {
    if (failed || size > bytes_.size()) {
      failed = true;
      return;
    }
    if (size > 0) std::memcpy(target, bytes_.data(), size);
    bytes_.remove_prefix(size);
  }
  std::string_view bytes_;
};

std::string padded(std::string_view text, std::size_t length) {
  std::string result(text.substr(0, length));
  result.resize(length);
  return result;
}

void write_state(Writer& writer, const TimeState& state) {
  writer.number(state.order);
  writer.number(state.steps_at_order);
  writer.number(state.next_step);
  writer.matrix(state.traction);
  writer.number(state.inlet_pressure);
  writer.number(std::uint64_t(state.levels.size()));
  for (const TimeLevel& level : state.levels) {
    writer.number(level.time);
    writer.number(level.frame_acceleration);
    writer.number(level.position);
    writer.matrix(level.outward);
    writer.matrix(level.unknowns);
    writer.matrix(level.velocities);
  }
}

TimeState read_state(Reader& reader) {
  TimeState state;
  state.order = reader.number<int>();
  state.steps_at_order = reader.number<int>();
  state.next_step = reader.number<double>();
  state.traction = reader.matrix<Eigen::VectorXd>();
  state.inlet_pressure = reader.number<double>();
  state.levels.resize(reader.count(32));
  for (TimeLevel& level : state.levels) {
    level.time = reader.number<double>();
    level.frame_acceleration = reader.number<double>();
    level.position = reader.number<double>();
    level.outward = reader.matrix<Eigen::VectorXd>();
    level.unknowns = reader.matrix<Eigen::VectorXd>();
    level.velocities = reader.matrix<Eigen::VectorXd>();
  }
  return state;
}

[[noreturn]] void refuse(const fs::path& file, const std::string& reason) {
  throw UserError(fmt::format("{}: {}", file.string(), reason));
}

std::optional<std::string> content_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return {};
  return std::string(std::istreambuf_iterator<char>(stream), {});
}

}  // namespace

std::string time_case_hash(const Case& c) {
  Case same = c;
  same.time.end_us = 1;
  return case_hash(same);
}

std::string checkpoint_file(int slot) { return fmt::format("checkpoint-{}.bin", slot); }

std::string encode_checkpoint(const Checkpoint& checkpoint, const Case& c) {
  Writer writer;
  write_state(writer, checkpoint.state);
  writer.number(std::uint64_t(checkpoint.record.rows.size()));
  for (const HistoryRow& row : checkpoint.record.rows) writer.number(row);
  writer.number(std::uint64_t(checkpoint.record.frames.size()));
  for (const ContourFrame& frame : checkpoint.record.frames) {
    writer.number(frame.t_us);
    writer.matrix(frame.point_um);
  }
  std::string content = std::string(magic) + padded(version, version_length) + time_case_hash(c) + writer.bytes();
  const std::uint64_t sum = checksum(content);
  return content.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

Checkpoint decode_checkpoint(const std::string& content, const Case& c, const fs::path& file) {
  const std::string hash = time_case_hash(c);
  const std::size_t head = magic.size() + version_length + hash.size();
  std::uint64_t sum = 0;
  if (!content.starts_with(magic) || content.size() < head + sizeof sum)
    refuse(file, "is no checkpoint of rheocyte, or only its beginning.");
  const std::string_view body = std::string_view(content).substr(0, content.size() - sizeof sum);
  std::memcpy(&sum, content.data() + body.size(), sizeof sum);
  if (sum != checksum(body)) refuse(file, "is damaged, its checksum does not fit; start anew without --continue.");
  if (body.substr(magic.size(), version_length) != padded(version, version_length))
    refuse(file, "is of another version of rheocyte; start anew without --continue.");
  if (body.substr(magic.size() + version_length, hash.size()) != hash)
    refuse(file, "is of another case; only time.end_us may differ from the case that it continues.");
  Reader reader(body.substr(head));
  Checkpoint checkpoint;
  checkpoint.state = read_state(reader);
  checkpoint.record.rows.resize(reader.count(sizeof(HistoryRow)));
  for (HistoryRow& row : checkpoint.record.rows) row = reader.number<HistoryRow>();
  checkpoint.record.frames.resize(reader.count(sizeof(double)));
  for (ContourFrame& frame : checkpoint.record.frames) {
    frame.t_us = reader.number<double>();
    frame.point_um = reader.matrix<Eigen::MatrixX2d>();
  }
  if (!reader.at_end() || checkpoint.state.levels.empty() || checkpoint.record.rows.empty())
    refuse(file, "is damaged, its content is incomplete; start anew without --continue.");
  return checkpoint;
}

Checkpoint read_checkpoint(const fs::path& folder, const Case& c) {
  std::optional<Checkpoint> latest;
  std::optional<UserError> failure;
  for (const int slot : {1, 2}) {
    const fs::path file = folder / checkpoint_file(slot);
    const auto content = content_of(file);
    if (!content) continue;
    try {
      Checkpoint checkpoint = decode_checkpoint(*content, c, file);
      if (!latest || checkpoint.record.rows.back().t_us > latest->record.rows.back().t_us) latest = checkpoint;
    } catch (const UserError& error) {
      failure = error;
    }
  }
  if (!latest && failure) throw *failure;
  if (!latest) refuse(folder, "holds no checkpoint; --continue takes the folder of a result with a [time] section.");
  if (const double reached = latest->record.rows.back().t_us; reached > *c.time.end_us * (1 + 1e-12))
    refuse(folder,
           fmt::format("has reached {:g} us already, time.end_us = {:g} lies before it.", reached, *c.time.end_us));
  return *latest;
}

TimeStart read_start(const fs::path& folder, const Case& c) {
  const fs::path file = folder / "case.toml";
  if (!fs::exists(file)) refuse(folder, "holds no result of rheocyte; --start takes the folder of a result in time.");
  const Case other = read_case(file);
  if (other.time.scheme == TimeScheme::stationary)
    refuse(folder, "is a stationary result, which has no checkpoint; --start takes the folder of a result in time.");
  const bool implicit = c.time.scheme == TimeScheme::monolithic && other.time.scheme == TimeScheme::monolithic;
  const bool straight = c.channel.profile.x_um.empty() && other.channel.profile.x_um.empty();
  if (!implicit || !straight)
    refuse(folder, "cannot be a start: that is for time.scheme = \"monolithic\" in straight channels, here and there.");
  if (tube_radius_um(c) != tube_radius_um(other) || c.cell.radius_um != other.cell.radius_um ||
      c.time.degree != other.time.degree || c.flow.drive != other.flow.drive ||
      c.channel.length_um != other.channel.length_um)
    refuse(folder,
           "is of another size; cell.radius_um, the channel, flow.drive and time.degree must be those of the start.");
  const Scales now = scales_of(c), then = scales_of(other);
  return {read_checkpoint(folder, other).state,
          UnitChange{then.velocity_m_per_s / now.velocity_m_per_s, then.stress_Pa / now.stress_Pa}};
}

}  // namespace rheocyte
