#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace swallowtail {

/// Why a call gave no value. `message` is a whole sentence for people; `code` is for programs.
struct Error {
  enum class Code : std::uint8_t { kBadInput, kNotFound, kInfeasible, kTimeout, kInterrupted, kInternal };
  Code code = Code::kInternal;
  std::string message;
};

inline Error bad_input(std::string message) { return {Error::Code::kBadInput, std::move(message)}; }
inline Error not_found(std::string message) { return {Error::Code::kNotFound, std::move(message)}; }
inline Error infeasible(std::string message) { return {Error::Code::kInfeasible, std::move(message)}; }
inline Error internal_error(std::string message) { return {Error::Code::kInternal, std::move(message)}; }

/// A value or an Error. There is no empty state; reading the side that is not there is a bug
/// (std::bad_variant_access).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value)
      : state_(std::in_place_index<0>, std::move(value)) {}  // NOLINT(google-explicit-constructor)
  Result(Error error)
      : state_(std::in_place_index<1>, std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return state_.index() == 0; }
  explicit operator bool() const { return ok(); }

  T& value() & { return std::get<0>(state_); }
  const T& value() const& { return std::get<0>(state_); }
  T&& value() && { return std::get<0>(std::move(state_)); }
  T& operator*() & { return value(); }
  const T& operator*() const& { return value(); }
  T* operator->() { return &value(); }
  const T* operator->() const { return &value(); }

  const Error& error() const { return std::get<1>(state_); }

 private:
  std::variant<T, Error> state_;
};

/// Success or an Error.
class [[nodiscard]] Status {
 public:
  Status() = default;
  Status(Error error) : error_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  const Error& error() const { return *error_; }

 private:
  std::optional<Error> error_;
};

}  // namespace swallowtail
