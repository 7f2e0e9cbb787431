#include <fmt/core.h>

#include "tools/cli/cover_files.hpp"

namespace swallowtail::cli {

std::string cover_csv(const nlohmann::ordered_json& json) {
  std::string out =
      "task,field,sub_cell,kind,from_x_m,from_y_m,from_z_m,to_x_m,to_y_m,to_z_m,height_m,transfer,energy_"
      "before,energy_after,start_s,end_s,bends_m,aircraft\n";
  for (const nlohmann::ordered_json& leg : json["legs"]) {
    const auto& a = leg["from_m"];
    const auto& b = leg["to_m"];
    std::string bends;  // x y z; x y z of the transfer that follows
    for (const nlohmann::ordered_json& bend : leg["transfer_m"])
      bends += fmt::format("{}{} {} {}", bends.empty() ? "" : "; ", bend[0].dump(), bend[1].dump(),
                           bend[2].dump());
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", leg["task"].dump(),
                       leg["field"].dump(), leg["sub_cell"].dump(), leg["kind"].get<std::string>(),
                       a[0].dump(), a[1].dump(), a[2].dump(), b[0].dump(), b[1].dump(), b[2].dump(),
                       leg["height_m"].dump(), leg["transfer"].get<std::string>(),
                       leg["energy_before"].dump(), leg["energy_after"].dump(), leg["start_s"].dump(),
                       leg["end_s"].dump(), bends, leg.value("aircraft", 1));
  }
  return out;
}

}  // namespace swallowtail::cli
