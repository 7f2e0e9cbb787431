#pragma once

#include <string>

namespace swallowtail::mission {

/// The folder of the running program; the participants stand beside it.
std::string program_folder();

}  // namespace swallowtail::mission
