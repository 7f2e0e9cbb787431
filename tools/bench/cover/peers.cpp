#include "tools/bench/cover/peers.hpp"

#include <fstream>
#include <sstream>

namespace swallowtail::bench {

Result<std::vector<CoverPeer>> read_cover_peers(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) return not_found("The file " + path.string() + " cannot be opened.");
  std::vector<CoverPeer> peers;
  std::string line;
  std::getline(file, line);
  for (int number = 2; std::getline(file, line); ++number) {
    if (line.empty()) continue;
    std::istringstream cells(line);
    CoverPeer peer;
    if (!std::getline(cells, peer.subject, ',') || !std::getline(cells, peer.case_name, ',') ||
        !std::getline(cells, peer.seconds, ',') || !std::getline(cells, peer.remark)) {
      return bad_input(path.string() + ":" + std::to_string(number) + ": must have four cells.");
    }
    peers.push_back(std::move(peer));
  }
  return peers;
}

std::string peers_cell(const std::vector<CoverPeer>& peers, const std::string& case_name) {
  std::string cell;
  for (const CoverPeer& peer : peers) {
    if (peer.case_name != case_name) continue;
    if (!cell.empty()) cell += "; ";
    cell += peer.subject + ": " + (peer.seconds.empty() ? "" : peer.seconds + " s, ") + peer.remark;
  }
  return cell.empty() ? "-" : cell;
}

}  // namespace swallowtail::bench
