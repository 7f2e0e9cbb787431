#pragma once

#include <string>

#include "tools/record/options.hpp"
#include "tools/record/session.hpp"

namespace swallowtail::record {

/// What a finished recording holds, for people.
std::string summary_text(const Options& options, const SessionSummary& summary);

/// The same as one JSON document.
std::string summary_json(const Options& options, const SessionSummary& summary);

}  // namespace swallowtail::record
