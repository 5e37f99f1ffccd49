// Tests that builds with sanitizers leave out, since there they take minutes and show nothing new.
#pragma once

#include <gtest/gtest.h>

namespace scumble::test {

#if defined(__SANITIZE_ADDRESS__)
constexpr bool kSanitized = true;
#else
constexpr bool kSanitized = false;
#endif

// For tests that compare many pictures, drawn on ways that other tests take as well.
#define NOT_WITH_SANITIZERS() \
  if (::scumble::test::kSanitized) GTEST_SKIP() << "only what is in pictures counts here"

}  // namespace scumble::test
