// std::barrier, which hangs on Windows in the C++ library of GCC 12.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <mutex>

class Barrier {
  public:
    explicit Barrier(size_t threads) : threads_(threads) {}

    void arrive_and_wait() {
        std::unique_lock lock(mutex_);
        ++here_;
        if (!let_go())
            all_.wait(lock, [this, met = met_] { return met_ != met; });
    }
    void arrive_and_drop() {
        const std::lock_guard lock(mutex_);
        --threads_;
        let_go();
    }

  private:
    bool let_go() {
        if (here_ < threads_)
            return false;
        here_ = 0;
        ++met_;
        all_.notify_all();
        return true;
    }

    std::mutex mutex_;
    std::condition_variable all_;
    size_t threads_, here_ = 0, met_ = 0;
};
