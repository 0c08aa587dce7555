// SPDX-License-Identifier: BSD-3-Clause
// Copyright 2026 the Yoke authors
#include <yoke/cases/sweep/mpi_ranks.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include <yoke/core/error.hpp>

#ifdef YOKE_MPI
#define OMPI_SKIP_MPICXX 1
#define MPICH_SKIP_MPICXX 1
#include <mpi.h>

#include <chrono>
#include <cstdint>
#include <cstring>
#include <exception>
#include <list>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include <yoke/integrators/studies/work_pool.hpp>
#endif

namespace yoke::cases {

std::size_t points_of_message(double mean, std::size_t left, int ranks, int jobs) {
  constexpr double worth_its_way = 0.05;  // [s]
  const auto threads = static_cast<std::size_t>(jobs);
  if (!(mean > 0.0)) return threads;
  const auto by_time =
      static_cast<std::size_t>(std::min(worth_its_way / mean, 1e6) * static_cast<double>(jobs));
  const std::size_t fair = left / (4 * static_cast<std::size_t>(ranks));
  return std::max(threads, std::min(by_time, fair));
}

namespace {

/// As Open MPI, MPICH and Slurm tell the programs they start.
int ranks_started() {
  for (const char* name : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE", "PMIX_SIZE", "SLURM_NTASKS"}) {
    const char* text = std::getenv(name);
    if (text == nullptr) continue;
    // Slurm sets its variable for the script of a job too, which is no task of it.
    if (name[0] == 'S' && std::getenv("SLURM_STEP_ID") == nullptr) continue;
    return std::max(1, std::atoi(text));
  }
  return 1;
}

}  // namespace

#ifdef YOKE_MPI

const bool has_mpi = true;

namespace {

enum Tag : int { points_tag, rows_tag, stop_tag, bye_tag };

constexpr double short_point = 0.02;  // [s] below, a rank has its next points before it asks
constexpr auto nap = std::chrono::microseconds(100);

using Bytes = std::vector<char>;

template <class Number>
void put(Bytes& bytes, Number number) {
  const auto* begin = reinterpret_cast<const char*>(&number);
  bytes.insert(bytes.end(), begin, begin + sizeof number);
}

template <class Number>
Number take(const Bytes& bytes, std::size_t& at) {
  Number number;
  std::memcpy(&number, bytes.data() + at, sizeof number);
  at += sizeof number;
  return number;
}

void put_row(Bytes& bytes, const StudyRow& row) {
  put<std::uint64_t>(bytes, row.point);
  put<std::int32_t>(bytes, static_cast<std::int32_t>(row.state));
  put(bytes, row.seconds);
  put<std::uint64_t>(bytes, row.values.size());
  for (const double x : row.values) put(bytes, x);
  put<std::uint64_t>(bytes, row.reason.size());
  bytes.insert(bytes.end(), row.reason.begin(), row.reason.end());
}

StudyRow take_row(const Bytes& bytes, std::size_t& at) {
  StudyRow row{.point = take<std::uint64_t>(bytes, at)};
  row.state = static_cast<PointState>(take<std::int32_t>(bytes, at));
  row.seconds = take<double>(bytes, at);
  row.values.resize(take<std::uint64_t>(bytes, at));
  for (double& x : row.values) x = take<double>(bytes, at);
  const auto length = take<std::uint64_t>(bytes, at);
  row.reason.assign(bytes.data() + at, length);
  at += length;
  return row;
}

struct Message {
  int rank = 0, tag = 0;
  Bytes bytes{};
};

void send_to(int rank, Tag tag, const Bytes& bytes) {
  MPI_Send(bytes.data(), static_cast<int>(bytes.size()), MPI_BYTE, rank, tag, MPI_COMM_WORLD);
}

/// Messages that do not wait for their receiver: who is sending rows to us does not take points meanwhile.
class Outbox {
 public:
  void send(int rank, Tag tag, Bytes bytes) {
    std::erase_if(letters_, [](Letter& letter) { return letter.gone(); });
    Letter& letter = letters_.emplace_back(Letter{std::move(bytes)});
    MPI_Isend(letter.bytes.data(), static_cast<int>(letter.bytes.size()), MPI_BYTE, rank, tag,
              MPI_COMM_WORLD, &letter.request);
  }
  void wait() {
    for (Letter& letter : letters_) MPI_Wait(&letter.request, MPI_STATUS_IGNORE);
    letters_.clear();
  }

 private:
  struct Letter {
    Bytes bytes{};
    MPI_Request request = MPI_REQUEST_NULL;
    bool gone() {
      int done = 0;
      MPI_Test(&request, &done, MPI_STATUS_IGNORE);
      return done != 0;
    }
  };
  std::list<Letter> letters_;  // that stay where they are
};

/// True if there was one. MPI's own waiting would keep a processor busy.
bool receive(Message& message) {
  int there = 0, size = 0;
  MPI_Status status;
  MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &there, &status);
  if (there == 0) return false;
  MPI_Get_count(&status, MPI_BYTE, &size);
  message = {status.MPI_SOURCE, status.MPI_TAG, Bytes(static_cast<std::size_t>(size))};
  MPI_Recv(message.bytes.data(), size, MPI_BYTE, message.rank, message.tag, MPI_COMM_WORLD,
           MPI_STATUS_IGNORE);
  return true;
}

Message wait_for_message() {
  Message message;
  while (!receive(message)) std::this_thread::sleep_for(nap);
  return message;
}

/// A rank other than 0: points in, rows out, until it is sent home.
void help(const StudyWork& work, int jobs) {
  for (;;) {
    const Message message = wait_for_message();
    if (message.tag == stop_tag) break;
    std::vector<std::uint64_t> points(message.bytes.size() / sizeof(std::uint64_t));
    std::memcpy(points.data(), message.bytes.data(), message.bytes.size());
    std::vector<StudyRow> rows(points.size());
    run_parallel(points.size(), jobs, [&](std::size_t i) {
      rows[i].point = points[i];
      if (!work.stopped()) rows[i] = work.compute(points[i]);
    });
    Bytes bytes;
    put<std::uint64_t>(bytes, rows.size());
    for (const StudyRow& row : rows) put_row(bytes, row);
    send_to(0, rows_tag, bytes);
  }
  send_to(0, bye_tag, {});
}

void send_home(int ranks) {
  for (int r = 1; r < ranks; ++r) send_to(r, stop_tag, {});
}

/// Rank 0: hands out, takes in, and has threads of its own that compute.
class Dispatcher {
 public:
  Dispatcher(const StudyWork& work, int ranks, int jobs)
      : work_(work), ranks_(ranks), jobs_(jobs), under_way_(static_cast<std::size_t>(ranks), 0) {}

  void run() {
    std::vector<std::jthread> own;
    for (int i = 0; i < jobs_; ++i) own.emplace_back([this] { compute(); });
    try {
      for (int r = 1; r < ranks_; ++r) hand_out(r);
      while (busy()) look();
    } catch (...) {
      fail();
    }
    own.clear();  // joins
    send_home(ranks_);
    for (int at_work = ranks_ - 1; at_work > 0;)
      if (const Message message = wait_for_message(); message.tag == bye_tag)
        --at_work;
      else
        take_in(message);
    outbox_.wait();
    if (error_) std::rethrow_exception(error_);
  }

 private:
  /// One point at a time: whoever is free takes the next.
  void compute() {
    for (;;) {
      std::size_t point = 0;
      {
        const std::lock_guard lock(mutex_);
        if (error_ || next_ == work_.points.size() || work_.stopped()) return;
        point = work_.points[next_++];
      }
      try {
        StudyRow row = work_.compute(point);
        count(row);
        if (row.state != PointState::missing) work_.deliver({std::move(row)});
      } catch (...) {
        fail();
      }
    }
  }
  void fail() {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::current_exception();
  }
  void count(const StudyRow& row) {
    const std::lock_guard lock(mutex_);
    seconds_ += row.seconds;
    ++computed_;
  }
  bool busy() {
    const std::lock_guard lock(mutex_);
    if (error_) return false;
    if (std::ranges::any_of(under_way_, [](int n) { return n > 0; })) return true;
    return next_ < work_.points.size() && !work_.stopped();
  }
  void look() {
    Message message;
    if (!receive(message)) {
      std::this_thread::sleep_for(nap);
      return;
    }
    take_in(message);
    hand_out(message.rank);
  }
  void take_in(const Message& message) {
    std::size_t at = 0;
    std::vector<StudyRow> rows(take<std::uint64_t>(message.bytes, at));
    for (StudyRow& row : rows) {
      row = take_row(message.bytes, at);
      count(row);
    }
    --under_way_[static_cast<std::size_t>(message.rank)];
    std::erase_if(rows, [](const StudyRow& row) { return row.state == PointState::missing; });
    try {
      if (!rows.empty()) work_.deliver(rows);
    } catch (...) {
      fail();
    }
  }
  void hand_out(int rank) {
    int& under_way = under_way_[static_cast<std::size_t>(rank)];
    for (;;) {
      Bytes bytes;
      {
        const std::lock_guard lock(mutex_);
        const double mean = computed_ > 0 ? seconds_ / static_cast<double>(computed_) : 0.0;
        const int most = computed_ > 0 && mean < short_point ? 2 : 1;
        if (under_way >= most || error_ || work_.stopped()) return;
        const std::size_t left = work_.points.size() - next_;
        std::size_t n = std::min(left, points_of_message(mean, left, ranks_, jobs_));
        if (n == 0) return;
        for (; n > 0; --n) put<std::uint64_t>(bytes, work_.points[next_++]);
      }
      outbox_.send(rank, points_tag, std::move(bytes));
      ++under_way;
    }
  }

  const StudyWork& work_;
  int ranks_, jobs_;
  std::mutex mutex_;
  std::size_t next_ = 0, computed_ = 0;
  double seconds_ = 0.0;        // [s] of what was computed
  std::vector<int> under_way_;  // messages, by rank; of the thread that talks
  std::exception_ptr error_;
  Outbox outbox_;
};

}  // namespace

MpiRanks::MpiRanks() {
  if (ranks_started() < 2) return;
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
  if (provided < MPI_THREAD_FUNNELED)
    throw ModelError("this MPI does not allow threads beside the one that talks");
}

MpiRanks::~MpiRanks() {
  int begun = 0;
  MPI_Initialized(&begun);
  if (begun == 0) return;
  if (rank_ == 0 && !dismissed_) send_home(size_);
  MPI_Finalize();
}

StudyExecutor MpiRanks::executor(int jobs) {
  if (size_ < 2) return on_threads(jobs);
  jobs = std::max(jobs, 1);
  return [this, jobs](const StudyWork& work) {
    dismissed_ = true;
    if (rank_ > 0) return help(work, jobs);
    Dispatcher(work, size_, jobs).run();
  };
}

#else

const bool has_mpi = false;

MpiRanks::MpiRanks() {
  if (ranks_started() > 1)
    throw ModelError(
        "started on several ranks, but built without MPI; configure with -DYOKE_MPI=ON (Debian: "
        "libopenmpi-dev), or run it once with --jobs");
}

MpiRanks::~MpiRanks() = default;

StudyExecutor MpiRanks::executor(int jobs) { return on_threads(jobs); }

#endif

}  // namespace yoke::cases
