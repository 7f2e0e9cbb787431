#pragma once

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace swallowtail::cli {

/// Tells on standard error how a longer computation stands: from its third second on, once a second. Ends
/// with the object.
class Progress {
 public:
  enum class Show { kYes, kNo };

  Progress(std::string what, Show show);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// What the next line says; from any thread.
  void update(std::string state);

 private:
  void run();

  std::string what_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::string state_;
  bool ended_ = false;
  std::thread thread_;
};

}  // namespace swallowtail::cli
