#include "coverage/gtsp/detail/token_reader.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <istream>

namespace swallowtail::gtsp::detail {
namespace {

constexpr std::size_t kMaxToken = 64;
constexpr std::size_t kMaxLine = 1024;

bool is_space(int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == '\v' || c == '\f'; }
bool is_key_character(char c) {
  return (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
}

std::string trimmed(const std::string& text) {
  const auto begin = std::find_if_not(text.begin(), text.end(), is_space);
  const auto end = std::find_if_not(text.rbegin(), std::make_reverse_iterator(begin), is_space).base();
  return {begin, end};
}

/// What may stand in a message: printable ASCII.
std::string printable(const std::string& text) {
  std::string shown = text.substr(0, kMaxToken);
  for (char& c : shown) {
    if (c < ' ' || c > '~') c = '?';
  }
  return shown;
}

template <class Number>
std::optional<Number> parsed(const std::string& text) {
  const char* begin = text.data();
  const char* const end = begin + text.size();
  if (begin != end && *begin == '+') ++begin;
  Number number{};
  const auto [stop, code] = std::from_chars(begin, end, number);
  if (code != std::errc{} || stop != end) return std::nullopt;
  return number;
}

}  // namespace

std::optional<int> parsed_int(const std::string& text) { return parsed<int>(text); }
std::optional<double> parsed_double(const std::string& text) { return parsed<double>(text); }

std::string upper_case(std::string text) {
  for (char& c : text) {
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  }
  return text;
}

int TokenReader::get() {
  const int c = in_.get();
  if (c == '\n') ++line_;
  return c;
}

std::optional<TokenReader::Line> TokenReader::next_line() {
  std::string text;
  int c = 0;
  do {
    text.clear();
    read_line_ = line_;
    for (c = get(); c != '\n' && c != std::char_traits<char>::eof(); c = get()) {
      if (text.size() < kMaxLine) text.push_back(static_cast<char>(c));
    }
    text = trimmed(text);
  } while (text.empty() && c == '\n');
  if (text.empty()) return std::nullopt;
  const auto key_end = std::find_if_not(text.begin(), text.end(), is_key_character);
  Line line{upper_case({text.begin(), key_end}), trimmed({key_end, text.end()})};
  if (!line.value.empty() && line.value.front() == ':') line.value = trimmed(line.value.substr(1));
  return line;
}

std::optional<std::string> TokenReader::next_token() {
  int c = get();
  while (is_space(c)) c = get();
  read_line_ = line_;
  std::string token;
  while (c != std::char_traits<char>::eof()) {
    if (token.size() <= kMaxToken) token.push_back(static_cast<char>(c));
    const int next = in_.peek();
    if (is_space(next) || next == std::char_traits<char>::eof()) break;
    c = get();
  }
  if (token.empty()) return std::nullopt;
  return token;
}

Result<int> TokenReader::next_int(const std::string& key) {
  const auto token = next_token();
  if (!token) return error(key, "end of file", "an integer must stand here");
  const auto number = parsed_int(*token);
  if (!number) return error(key, *token, "must be an integer");
  return *number;
}

Result<double> TokenReader::next_double(const std::string& key) {
  const auto token = next_token();
  if (!token) return error(key, "end of file", "a number must stand here");
  const auto number = parsed_double(*token);
  if (!number) return error(key, *token, "must be a number");
  return *number;
}

Error TokenReader::error(const std::string& key, const std::string& value, const std::string& rule) const {
  return bad_input(name_ + ":" + std::to_string(read_line_) + ": " + printable(key) + ": " +
                   printable(value) + ": " + rule);
}

}  // namespace swallowtail::gtsp::detail
