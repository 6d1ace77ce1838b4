// What is the same with processes and without.
#include "case/user_error.h"
#include "store/work_host.h"

namespace rheocyte {

void WorkReply::run_isolated(const std::filesystem::path& file, const std::function<void(const TellProgress&)>& work,
                             const Isolation& limits) const {
  const auto isolated = [&](const TellProgress& tell) {
    work(tell);
    return std::string();
  };
  const IsolatedEnd end = run_isolated_bytes(
      isolated, limits,
      {.progress = [this](double done) { report_progress(done); }, .stop = [this] { return !is_wanted(); }});
  if (end.kind == IsolatedEnd::Kind::stopped) throw UserError("The request was cancelled.");
  if (end.kind != IsolatedEnd::Kind::finished) throw UserError(sentence_for(file, end, limits.patience_s));
}

std::string HostedWork::all(const Watch& watch) {
  std::string text;
  read(
      [&](std::string_view piece) {
        text += piece;
        return true;
      },
      watch);
  return text;
}

}  // namespace rheocyte
