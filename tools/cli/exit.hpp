#pragma once

namespace swallowtail::cli {

/// Exit codes of every command; their meaning is part of the stable surface.
enum class Exit : int {
  kDone = 0,         ///< done and certified
  kNone = 1,         ///< no (complete) answer found; `status` says why
  kUsage = 2,        ///< bad input or usage
  kInterrupted = 3,  ///< stopped by a signal; the best so far is written
  kInternal = 4,
};

inline constexpr const char* kExitCodesHelp =
    "Exit codes: 0 done and certified; 1 no (complete) answer found, the reason in status; 2 bad input or "
    "usage;\n"
    "3 interrupted, best so far written; 4 internal error.";

}  // namespace swallowtail::cli
