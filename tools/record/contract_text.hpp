#pragma once

#include <span>
#include <string_view>

namespace swallowtail::record {

/// One IDL file of the contract, preprocessed when this was built (embed_idl.cmake).
struct IdlText {
  std::string_view family;  ///< the file's name without .idl
  std::string_view text;
};

std::span<const IdlText> contract_texts();

}  // namespace swallowtail::record
