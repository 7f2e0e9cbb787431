#pragma once

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <thread>
#include <vector>

#include <Eigen/Core>

namespace swallowtail::planner {

/// A fixed crew of threads that share out the columns of a batch. A column's result must depend on that
/// column alone: then the results are the same at any number of threads. Handing out work takes no memory.
/// For one caller at a time.
class Workers {
 public:
  /// The calling thread is one of them: 1 starts none, and so does less.
  explicit Workers(int threads);
  ~Workers();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;

  int threads() const { return static_cast<int>(crew_.size()) + 1; }

  /// Calls work(first, last) for ranges that together make up 0 … count, each once; every range but the last
  /// begins and ends at a multiple of `grain` (≥ 1). Returns when all are done. `work` must not throw.
  template <class Work>
  void for_ranges(Eigen::Index count, Eigen::Index grain, const Work& work) {
    run({count, grain, &work, [](const void* context, Eigen::Index first, Eigen::Index last) {
           (*static_cast<const Work*>(context))(first, last);
         }});
  }

 private:
  struct Task {
    Eigen::Index count = 0;
    Eigen::Index grain = 1;
    const void* context = nullptr;
    void (*call)(const void* context, Eigen::Index first, Eigen::Index last) = nullptr;
  };

  void run(const Task& task);
  void work_share(const Task& task, Eigen::Index member) const;
  void serve(Eigen::Index member);

  std::mutex mutex_;
  std::condition_variable task_given_;
  std::condition_variable all_done_;
  Task task_;
  std::uint64_t tasks_given_ = 0;
  int at_work_ = 0;
  bool stops_ = false;
  std::vector<std::thread> crew_;
};

}  // namespace swallowtail::planner
