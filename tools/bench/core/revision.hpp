#pragma once

namespace swallowtail::bench {

/// The source revision this was built from; ends in "+" when files differ from it, "unknown" outside a
/// checkout.
extern const char* const kRevision;

}  // namespace swallowtail::bench
