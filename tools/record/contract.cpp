#include "tools/record/contract.hpp"

#include <algorithm>
#include <string>

#include "tools/record/contract_text.hpp"

namespace swallowtail::record {
const TopicQos* find_topic(std::string_view name) {
  const auto* found =
      std::find_if(kTopics.begin(), kTopics.end(), [name](const TopicQos& t) { return t.name == name; });
  return found == kTopics.end() ? nullptr : found;
}

std::string_view contract_idl(std::string_view type_name) {
  const std::size_t colon = type_name.rfind(':');
  const std::string declaration =
      "struct " + std::string(type_name.substr(colon == std::string_view::npos ? 0 : colon + 1)) + " {";
  for (const IdlText& idl : contract_texts()) {
    if (idl.text.find(declaration) != std::string_view::npos) return idl.text;
  }
  return {};
}

}  // namespace swallowtail::record
