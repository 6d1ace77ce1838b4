#include "app/checkpoint.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>
#include <optional>
#include <utility>

#include "case/read_case.h"
#include "case/refuse_path.h"
#include "case/scales.h"
#include "case/to_path.h"
#include "case/user_error.h"
#include "case/write_case.h"
#include "numeric/fingerprint.h"
#include "store/build_info.h"
#include "store/bytes.h"
#include "store/read_file.h"
#include "store/result_folder.h"

namespace rheocyte {

template <>
struct FieldsOf<TimeLevel> {
  template <class Self>
  static auto fields(Self& l) {
    return std::tie(l.time, l.frame_acceleration, l.position, l.barycentre, l.aside, l.outward, l.branch, l.unknowns,
                    l.velocities);
  }
};

template <>
struct FieldsOf<Resolution> {
  template <class Self>
  static auto fields(Self& r) {
    auto& [front, top, ring, axial, layers] = r.subdivision;
    return std::tie(front, top, ring, axial, layers, r.degree);
  }
};

template <>
struct FieldsOf<Motion> {
  template <class Self>
  static auto fields(Self& m) {
    return std::tie(m.rate, m.unknowns, m.velocities, m.outward, m.branch, m.turning, m.turning_branch);
  }
};

template <>
struct FieldsOf<KeptTangent> {
  template <class Self>
  static auto fields(Self& t) {
    return std::tie(t.motion, t.axial_tension, t.aside, t.outward, t.unknowns);
  }
};

template <>
struct FieldsOf<TimeState> {
  template <class Self>
  static auto fields(Self& s) {
    return std::tie(s.order, s.steps_at_order, s.next_step, s.traction, s.inlet_pressure, s.resolution, s.tangent,
                    s.levels);
  }
};

namespace fs = std::filesystem;

namespace {

constexpr std::string_view magic = "rheocyte checkpoint\n";
constexpr std::size_t version_length = 32;

std::string padded(std::string_view text, std::size_t length) {
  std::string result(text.substr(0, length));
  result.resize(length);
  return result;
}

std::optional<std::string> content_of(const fs::path& file) {
  constexpr std::size_t enough = std::size_t{4} << 30U;
  return first_bytes(file, enough);
}

bool have_the_same_section(const Case& one, const Case& other) {
  const Channel &a = one.channel, &b = other.channel;
  if (a.section != b.section) return false;
  return is_duct(a.section) ? a.width_um == b.width_um && a.height_um == b.height_um
                            : tube_radius_um(one) == tube_radius_um(other);
}

double reached_us(const Checkpoint& checkpoint) { return checkpoint.record.rows.back().t_us; }

/// Finds the latest checkpoint of a case in several folders.
class CheckpointSearch {
 public:
  explicit CheckpointSearch(const Case& c) : case_(c) {}

  void look_into(Scratch place) {
    std::optional<Checkpoint> best;
    for (const int slot : {1, 2}) {
      const fs::path file = place.path / to_path(checkpoint_file(slot));
      const auto content = content_of(file);
      if (!content) continue;
      try {
        Checkpoint checkpoint = decode_checkpoint(*content, case_, file);
        if (!best || reached_us(checkpoint) > reached_us(*best)) best = std::move(checkpoint);
      } catch (const UserError& error) {
        failure_ = error;
      }
    }
    if (best && (!latest_ || reached_us(*best) > reached_us(latest_->checkpoint)))
      latest_ = {std::move(*best), place.path, std::move(place.claim)};
  }

  /// UserError that names the folder in which the user wanted it.
  FoundCheckpoint latest(const fs::path& wanted) && {
    if (!latest_ && failure_) throw *failure_;
    if (!latest_)
      refuse_path(wanted, "contains no checkpoint; --continue takes the folder of a result with a [time] section.");
    const HistoryRow& reached = latest_->checkpoint.record.rows.back();
    const auto refuse_beyond = [&](double at, const std::optional<double>& end, const char* unit) {
      if (end && at > *end * (1 + 1e-8))
        refuse_path(wanted, fmt::format("has already reached {:g} {}; time.end_{} = {:g} must be larger.", at, unit,
                                        unit, *end));
    };
    refuse_beyond(reached.t_us, case_.time.end_us, "us");
    refuse_beyond(reached.position_um, case_.time.end_um, "um");
    return std::move(*latest_);
  }

 private:
  const Case& case_;
  std::optional<FoundCheckpoint> latest_;
  std::optional<UserError> failure_;
};

}  // namespace

std::string time_case_hash(const Case& c) {
  Case same = c;
  same.time.end_us = 1;
  same.time.end_um.reset();
  return case_hash(same);
}

std::string checkpoint_file(int slot) { return fmt::format("checkpoint-{}.bin", slot); }

std::string encode_checkpoint(const Checkpoint& checkpoint, const Case& c) {
  std::string content = std::string(magic) + padded(version, version_length) + time_case_hash(c) + to_bytes(checkpoint);
  const std::uint64_t sum = fnv1a(content);
  return content.append(reinterpret_cast<const char*>(&sum), sizeof sum);
}

Checkpoint decode_checkpoint(const std::string& content, const Case& c, const fs::path& file) {
  const std::string hash = time_case_hash(c);
  const std::size_t head = magic.size() + version_length + hash.size();
  std::uint64_t sum = 0;
  if (!content.starts_with(magic) || content.size() < head + sizeof sum)
    refuse_path(file, "is not a checkpoint of rheocyte, or only the beginning of one.");
  const std::string_view body = std::string_view(content).substr(0, content.size() - sizeof sum);
  std::memcpy(&sum, content.data() + body.size(), sizeof sum);
  if (sum != fnv1a(body)) refuse_path(file, "is damaged: its checksum is wrong; start again without --continue.");
  if (body.substr(magic.size(), version_length) != padded(version, version_length))
    refuse_path(file, "was written by another version of rheocyte; start again without --continue.");
  if (body.substr(magic.size() + version_length, hash.size()) != hash)
    refuse_path(file,
                "belongs to another case; only time.end_us or time.end_um may differ from the case that it continues.");
  auto checkpoint = from_bytes<Checkpoint>(body.substr(head));
  if (!checkpoint || checkpoint->state.levels.empty() || checkpoint->record.rows.empty())
    refuse_path(file, "is damaged: its content is incomplete; start again without --continue.");
  return std::move(*checkpoint);
}

FoundCheckpoint find_checkpoint(const fs::path& folder, const Case& c) {
  CheckpointSearch search(c);
  search.look_into({folder, {}});
  for (auto& interrupted : interrupted_results(folder)) search.look_into(std::move(interrupted));
  return std::move(search).latest(folder);
}

Checkpoint read_checkpoint(const fs::path& folder, const Case& c) {
  CheckpointSearch search(c);
  search.look_into({folder, {}});
  return std::move(search).latest(folder).checkpoint;
}

TimeStart read_start(const fs::path& folder, const Case& c) {
  const fs::path file = folder / "case.toml";
  if (!fs::exists(file))
    refuse_path(folder, "contains no result of rheocyte; --start takes the folder of a result in time.");
  const Case other = read_case(file);
  if (other.time.scheme == TimeScheme::stationary)
    refuse_path(folder,
                "is a stationary result, which has no checkpoint; --start takes the folder of a result in time.");
  const bool implicit = c.time.scheme == TimeScheme::monolithic && other.time.scheme == TimeScheme::monolithic;
  const bool straight = c.channel.profile.x_um.empty() && other.channel.profile.x_um.empty();
  if (!implicit || !straight)
    refuse_path(
        folder,
        "cannot be a start: --start requires time.scheme = \"monolithic\" and a straight channel in both cases.");
  if (!have_the_same_section(c, other) || c.cell.radius_um != other.cell.radius_um ||
      c.time.degree.value_or(other.time.degree.value_or(0)) != other.time.degree.value_or(c.time.degree.value_or(0)) ||
      c.cell.viscoelasticity != other.cell.viscoelasticity || c.flow.drive != other.flow.drive ||
      c.channel.length_um != other.channel.length_um || c.cell.offset_um != other.cell.offset_um)
    refuse_path(folder,
                "differs too much from this case; cell.radius_um, cell.offset_um, the channel, flow.drive, "
                "cell.viscoelasticity and time.degree must be those of the start.");
  const Scales now = scales_of(c), then = scales_of(other);
  return {read_checkpoint(folder, other).state,
          UnitChange{then.velocity_m_per_s / now.velocity_m_per_s, then.stress_Pa / now.stress_Pa}};
}

}  // namespace rheocyte
