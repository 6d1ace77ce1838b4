// Of builds without processes: the work is done in its place. What breaks there ends the program.
#include <exception>
#include <new>

#include "case/user_error.h"
#include "store/in_place.h"
#include "store/isolated.h"
#include "store/stop_signal.h"

namespace rheocyte {

std::recursive_mutex& turn_of_work() {
  static std::recursive_mutex turn;
  return turn;
}

class IsolatedPool::Run {};

IsolatedPool::IsolatedPool(int at_once) : at_once_(at_once) {}
IsolatedPool::~IsolatedPool() = default;

void IsolatedPool::start(const IsolatedWork& work, const Isolation& limits, const Watch& watch, const OnEnd& on_end) {
  on_end(run_isolated_bytes(work, limits, watch));
}

void IsolatedPool::wait_for_all() {}

IsolatedEnd run_isolated_bytes(const IsolatedWork& work, const Isolation&, const Watch& watch) {
  using Kind = IsolatedEnd::Kind;
  std::exception_ptr thrown;  // by the watch: no matter of the work
  const auto tell = [&](double fraction) {
    try {
      watch.progress(fraction);
    } catch (...) {
      thrown = std::current_exception();
    }
    if (thrown || stop_wanted() || watch.stop()) throw StoppedBySignal{};
  };
  const std::scoped_lock alone(turn_of_work());
  try {
    return {Kind::finished, work(tell)};
  } catch (const StoppedBySignal&) {
    if (thrown) std::rethrow_exception(thrown);
    return {Kind::stopped, {}};
  } catch (const UserError& error) {
    return {Kind::user_error, error.what()};
  } catch (const std::bad_alloc&) {
    return {Kind::no_memory, {}};
  } catch (const std::exception& error) {
    return {Kind::own_error, error.what()};
  }
}

}  // namespace rheocyte
