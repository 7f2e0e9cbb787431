#include "coverage/gtsp/tour_file.hpp"

#include <fstream>
#include <iomanip>

#include "coverage/gtsp/detail/token_reader.hpp"
#include "coverage/gtsp/instance.hpp"

namespace swallowtail::gtsp {

Result<std::vector<int>> read_tour(std::istream& in, const std::string& name) {
  static const std::string kKey = "TOUR_SECTION";
  detail::TokenReader reader(in, name);
  auto line = reader.next_line();
  while (line && line->key != kKey) line = reader.next_line();
  if (!line) return reader.error(kKey, "missing", "must be given");
  std::vector<int> tour;
  for (auto token = reader.next_token(); token && detail::upper_case(*token) != "EOF";
       token = reader.next_token()) {
    const auto id = detail::parsed_int(*token);
    if (id && *id == -1) break;
    if (!id || *id < 1 || *id > kMaxVertices) {
      return reader.error(
          kKey, *token,
          "must be an integer from 1 to " + std::to_string(kMaxVertices) + ", or -1 to end the tour");
    }
    if (tour.size() >= static_cast<std::size_t>(kMaxVertices)) {
      return reader.error(kKey, *token,
                          "a tour may have at most " + std::to_string(kMaxVertices) + " vertices");
    }
    tour.push_back(*id - 1);
  }
  return tour;
}

Result<std::vector<int>> read_tour(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) return not_found("The file " + path.string() + " cannot be opened.");
  return read_tour(file, path.string());
}

Status write_tour(std::ostream& out, const std::string& name, std::span<const int> tour, double cost) {
  out << "NAME : " << name << "\nCOMMENT : Length " << std::setprecision(17) << cost
      << "\nTYPE : TOUR\nDIMENSION : " << tour.size() << "\nTOUR_SECTION\n";
  for (const int v : tour) out << v + 1 << '\n';
  out << "-1\nEOF\n";
  if (!out) return internal_error("The tour " + name + " could not be written.");
  return {};
}

}  // namespace swallowtail::gtsp
