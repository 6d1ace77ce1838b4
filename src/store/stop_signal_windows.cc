// Ctrl-C, Ctrl-Break and the end of the console as a wish that the program polls.
#include <windows.h>

#include <csignal>

#include "store/stop_signal.h"

namespace rheocyte {

namespace {

std::atomic<bool> wanted{false};
std::atomic<int> received{0};
std::atomic<bool> second_ends{true};

BOOL WINAPI note_event(DWORD event) {
  if (wanted.exchange(true) && second_ends) return FALSE;  // which ends the program
  received = event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? SIGINT : SIGTERM;
  if (event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT) return TRUE;
  ::Sleep(INFINITE);  // Windows ends the program when this returns, or after some seconds
  return TRUE;
}

}  // namespace

void watch_signals(SecondSignal second) {
  second_ends = second == SecondSignal::ends;
  ::SetConsoleCtrlHandler(nullptr, FALSE);  // who started the program may have had it ignore Ctrl-C
  ::SetConsoleCtrlHandler(note_event, TRUE);
}

const std::atomic<bool>& stop_wanted() { return wanted; }

int signal_received() { return received; }

}  // namespace rheocyte
