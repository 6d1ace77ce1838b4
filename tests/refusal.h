// The sentence of a refusal, for tests of bad input.
#pragma once
#include <string>

#include "case/user_error.h"

namespace rheocyte::test {

/// What the UserError of an action says; "accepted" if there is none.
template <class Action>
std::string refusal_of(Action&& action) {
  try {
    action();
  } catch (const UserError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace rheocyte::test
