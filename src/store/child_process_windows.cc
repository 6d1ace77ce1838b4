#include <windows.h>

#include <utility>

#include "case/to_path.h"
#include "store/child_process.h"
#include "store/environment.h"
#include "store/last_line.h"
#include "store/stop_signal.h"
#include "store/windows_errors.h"

namespace rheocyte {

namespace {

void close(HANDLE& handle) {
  if (handle) ::CloseHandle(std::exchange(handle, nullptr));
}

/// As programs take their one line apart: a backslash is one, unless it stands before a quotation mark.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t c : word) {
    if (c == L'"') text.append(backslashes + 1, L'\\');
    backslashes = c == L'\\' ? backslashes + 1 : 0;
    text += c;
  }
  return text.append(backslashes, L'\\') + L'"';
}

std::wstring command_line_of(const std::vector<std::string>& arguments) {
  std::wstring line;
  for (const auto& argument : arguments) line += (line.empty() ? L"" : L" ") + quoted(wide(argument));
  return line;
}

/// Where a shell would find it; Windows itself would look into the current folder before.
std::filesystem::path program_of(const std::vector<std::string>& arguments) {
  std::filesystem::path program = to_path(arguments[0]);
  return program.has_parent_path() ? program : program_in_path(arguments[0]);
}

struct Pipe {
  HANDLE read = nullptr, write = nullptr;
  bool made = false;

  /// The named end is for the new program, the other one stays ours.
  explicit Pipe(HANDLE Pipe::*given) {
    SECURITY_ATTRIBUTES handed_on{sizeof(SECURITY_ATTRIBUTES), nullptr, TRUE};
    made = ::CreatePipe(&read, &write, &handed_on, 0) != 0;
    if (made) ::SetHandleInformation(given == &Pipe::read ? write : read, HANDLE_FLAG_INHERIT, 0);
  }
};

/// What ends with this program, however that ends.
HANDLE job_of_ours() {
  static const HANDLE job = [] {
    const HANDLE made = ::CreateJobObjectW(nullptr, nullptr);
    JOBOBJECT_EXTENDED_LIMIT_INFORMATION limits{};
    limits.BasicLimitInformation.LimitFlags = JOB_OBJECT_LIMIT_KILL_ON_JOB_CLOSE;
    ::SetInformationJobObject(made, JobObjectExtendedLimitInformation, &limits, sizeof limits);
    return made;
  }();
  return job;
}

/// Nothing if it cannot be started. Ctrl-C in the console is not meant for it.
HANDLE start(const std::vector<std::string>& arguments, DWORD flags, STARTUPINFOW how) {
  const auto program = program_of(arguments);
  if (program.empty()) return nullptr;
  std::wstring line = command_line_of(arguments);
  PROCESS_INFORMATION made{};
  how.cb = sizeof how;
  if (!::CreateProcessW(program.c_str(), line.data(), nullptr, nullptr, TRUE, flags | CREATE_SUSPENDED, nullptr,
                        nullptr, &how, &made))
    return nullptr;
  ::AssignProcessToJobObject(job_of_ours(), made.hProcess);
  ::ResumeThread(made.hThread);
  ::CloseHandle(made.hThread);
  return made.hProcess;
}

/// All that it prints, or nothing more once the user wants to stop: then it is killed.
std::string output_of(HANDLE pipe, HANDLE child, bool wanted_before) {
  constexpr int pause = 20;
  std::string tail;
  char buffer[1024];
  for (;;) {
    DWORD waiting = 0, count = 0;
    if (!::PeekNamedPipe(pipe, nullptr, 0, nullptr, &waiting, nullptr)) return tail;
    if (waiting > 0 && ::ReadFile(pipe, buffer, sizeof buffer, &count, nullptr)) keep_tail(tail, {buffer, count});
    if (stop_wanted() && !wanted_before) ::TerminateProcess(child, 1);
    if (waiting == 0) pause_ms(pause);
  }
}

int exit_code_of(HANDLE child) {
  ::WaitForSingleObject(child, INFINITE);
  DWORD code = 1;
  ::GetExitCodeProcess(child, &code);
  return static_cast<int>(code);
}

}  // namespace

struct ChildProcess::Running {
  std::string name;
  HANDLE child = nullptr, input = nullptr, output = nullptr;
};

ChildProcess::ChildProcess(std::vector<std::string> arguments)
    : running_(std::make_unique<Running>(Running{arguments[0]})) {
  const Pipe input(&Pipe::read), output(&Pipe::write);
  if (input.made && output.made) {
    STARTUPINFOW how{};
    how.dwFlags = STARTF_USESTDHANDLES;
    how.hStdInput = input.read;
    how.hStdOutput = how.hStdError = output.write;
    running_->child = start(arguments, CREATE_NO_WINDOW | CREATE_NEW_PROCESS_GROUP, how);
    running_->input = input.write;
    running_->output = output.read;
  }
  for (const HANDLE theirs : {input.read, output.write})
    if (theirs) ::CloseHandle(theirs);
}

ChildProcess::~ChildProcess() {
  close(running_->input);
  close(running_->output);
  if (!running_->child) return;
  ::TerminateProcess(running_->child, 1);
  exit_code_of(running_->child);
  close(running_->child);
}

ChildResult ChildProcess::finish(std::string_view input) {
  Running& run = *running_;
  if (!run.child) return {-1, run.name + ".exe is not in the PATH, or cannot be started"};
  while (!input.empty()) {
    DWORD written = 0;
    if (!::WriteFile(run.input, input.data(), static_cast<DWORD>(input.size()), &written, nullptr)) break;
    input.remove_prefix(written);
  }
  close(run.input);
  const bool wanted_before = stop_wanted();
  const std::string tail = output_of(run.output, run.child, wanted_before);
  ChildResult result{exit_code_of(run.child), last_line_of(tail)};
  if (stop_wanted() && !wanted_before) result.exit_code = -1;
  close(run.child);
  return result;
}

/// Windows cannot replace a program by another one: it is waited for.
std::string become_program(std::vector<std::string> arguments) {
  const HANDLE child = start(arguments, 0, {});
  if (!child) return arguments[0] + " (it is not in the PATH, or cannot be started)";
  ::SetConsoleCtrlHandler(nullptr, TRUE);
  ::ExitProcess(static_cast<UINT>(exit_code_of(child)));
}

}  // namespace rheocyte
