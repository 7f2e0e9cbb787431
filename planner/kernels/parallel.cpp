#include "planner/kernels/parallel.hpp"

#include <algorithm>

namespace swallowtail::planner {

Workers::Workers(int threads) {
  for (int member = 1; member < threads; ++member) crew_.emplace_back([this, member] { serve(member); });
}

Workers::~Workers() {
  {
    const std::lock_guard lock(mutex_);
    stops_ = true;
  }
  task_given_.notify_all();
  for (std::thread& thread : crew_) thread.join();
}

void Workers::run(const Task& task) {
  // Handing a single grain to others costs more than it saves.
  if (crew_.empty() || task.count <= task.grain) {
    if (task.count > 0) task.call(task.context, 0, task.count);
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    task_ = task;
    ++tasks_given_;
    at_work_ = static_cast<int>(crew_.size());
  }
  task_given_.notify_all();
  work_share(task, 0);
  std::unique_lock lock(mutex_);
  all_done_.wait(lock, [this] { return at_work_ == 0; });
}

void Workers::work_share(const Task& task, Eigen::Index member) const {
  const Eigen::Index grains = (task.count + task.grain - 1) / task.grain;
  const Eigen::Index first = grains * member / threads() * task.grain;
  const Eigen::Index last = std::min(task.count, grains * (member + 1) / threads() * task.grain);
  if (first < last) task.call(task.context, first, last);
}

void Workers::serve(Eigen::Index member) {
  std::uint64_t seen = 0;
  std::unique_lock lock(mutex_);
  for (;;) {
    task_given_.wait(lock, [&] { return stops_ || tasks_given_ != seen; });
    if (stops_) return;
    seen = tasks_given_;
    const Task task = task_;
    lock.unlock();
    work_share(task, member);
    lock.lock();
    if (--at_work_ == 0) all_done_.notify_one();
  }
}

}  // namespace swallowtail::planner
