// What is the same with processes and without.
#include "case/user_error.h"
#include "store/work_host.h"

namespace rheocyte {

void WorkReply::run_isolated(const std::filesystem::path& file, const std::function<void(const TellProgress&)>& work,
                             Isolation limits) const {
  limits.is_wanted = [this] { return is_wanted(); };
  const auto isolated = [&](const TellProgress& tell) {
    work(tell);
    return std::string();
  };
  const IsolatedEnd end = run_isolated_bytes(isolated, limits, [this](double done) { report_progress(done); });
  if (end.kind == IsolatedEnd::Kind::stopped) throw UserError("Nobody waits any more for what was asked.");
  if (end.kind != IsolatedEnd::Kind::finished) throw UserError(sentence_for(file, end, limits.patience_s));
}

std::string HostedWork::all(const TellProgress& on_progress) {
  std::string text;
  read(
      [&](std::string_view piece) {
        text += piece;
        return true;
      },
      on_progress);
  return text;
}

}  // namespace rheocyte
