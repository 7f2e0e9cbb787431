# cmake -DSOURCE=folder -DOUT=file.cpp -P revision.cmake: writes the revision of the sources, if it changed.
execute_process(COMMAND git -C ${SOURCE} rev-parse --short=12 HEAD OUTPUT_VARIABLE revision
                OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed)
  set(revision unknown)
else()
  execute_process(COMMAND git -C ${SOURCE} status --porcelain --untracked-files=no OUTPUT_VARIABLE changes ERROR_QUIET)
  if(changes)
    string(APPEND revision "+")
  endif()
endif()
file(CONFIGURE OUTPUT ${OUT} CONTENT [[
#include "tools/bench/core/revision.hpp"
namespace swallowtail::bench {
const char* const kRevision = "@revision@";
}
]] @ONLY)
