#pragma once

#include "tools/cli/commands.hpp"

namespace swallowtail::cli {

void add_mission(CLI::App& app, Exit& exit);
void add_report(CLI::App& app, Exit& exit);

/// What `check SCENARIO --recording FILE` does.
Exit check_recording(const RecordingCheck& request);

}  // namespace swallowtail::cli
