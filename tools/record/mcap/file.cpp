#include "tools/record/mcap/file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace swallowtail::mcap {
namespace {

std::string reason_text(int reason) { return std::generic_category().message(reason); }

}  // namespace

Result<OutputFile> OutputFile::create(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
  if (descriptor < 0) return bad_input("Cannot create " + path.string() + ": " + reason_text(errno) + ".");
  return OutputFile(descriptor, path.string());
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), name_(std::move(other.name_)), size_(other.size_) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(name_, other.name_);
  std::swap(size_, other.size_);
  return *this;
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status OutputFile::fail(const char* what, int reason) const {
  return internal_error(std::string("Cannot ") + what + " " + name_ + ": " + reason_text(reason) + ".");
}

Status OutputFile::append(std::span<const std::byte> bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t count = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) {
      const int reason = count == 0 ? EIO : errno;
      if (::ftruncate(descriptor_, static_cast<off_t>(size_)) == 0)
        ::lseek(descriptor_, static_cast<off_t>(size_), SEEK_SET);
      return fail("write to", reason);
    }
    done += static_cast<std::size_t>(count);
  }
  size_ += done;
  return {};
}

Status OutputFile::sync() {
  if (::fdatasync(descriptor_) != 0 && errno != EINVAL) return fail("bring to the disk", errno);
  return {};
}

Status OutputFile::close() {
  if (descriptor_ < 0) return {};
  if (::close(std::exchange(descriptor_, -1)) != 0) return fail("close", errno);
  return {};
}

Result<InputFile> InputFile::open(const std::filesystem::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    const int reason = errno;
    const std::string message = "Cannot open " + path.string() + ": " + reason_text(reason) + ".";
    return reason == ENOENT ? not_found(message) : bad_input(message);
  }
  struct stat info {};
  if (::fstat(descriptor, &info) != 0 || !S_ISREG(info.st_mode)) {
    ::close(descriptor);
    return bad_input("Cannot read " + path.string() + ": it is not a regular file.");
  }
  return InputFile(descriptor, path.string(), static_cast<std::uint64_t>(info.st_size));
}

InputFile::InputFile(InputFile&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)), name_(std::move(other.name_)), size_(other.size_) {}

InputFile& InputFile::operator=(InputFile&& other) noexcept {
  std::swap(descriptor_, other.descriptor_);
  std::swap(name_, other.name_);
  std::swap(size_, other.size_);
  return *this;
}

InputFile::~InputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

Status InputFile::read(std::uint64_t offset, std::span<std::byte> into) const {
  if (offset > size_ || into.size() > size_ - offset)
    return bad_input(name_ + " ends before byte " + std::to_string(offset + into.size()) + ".");
  std::size_t done = 0;
  while (done < into.size()) {
    const ssize_t count =
        ::pread(descriptor_, into.data() + done, into.size() - done, static_cast<off_t>(offset + done));
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0)
      return bad_input("Cannot read " + name_ + ": " +
                       (count < 0 ? reason_text(errno) : "it has become shorter") + ".");
    done += static_cast<std::size_t>(count);
  }
  return {};
}

}  // namespace swallowtail::mcap
