#pragma once
#include <string>
#include <utility>
#include <vector>

#include "gpu/object.hpp"

namespace lockstep {

/// A GL_TIME_ELAPSED query that runs while this lives. A driver may put its begin off until it draws, and so time no
/// dispatch: at the barrier it begins.
class RunningTimer {
  public:
    explicit RunningTimer(const GlQuery& query);

  private:
    RunningQuery query_;
};

/// What a timer found; waits for the GPU.
double seconds_of(const GlQuery& query);

/// GPU time between marks by GL_TIMESTAMP queries. A mark may have the GPU wait for what was before it: frames that are
/// timed so are not those whose whole is timed.
class PassTimer {
  public:
    /// From here on the first pass's time counts.
    void start();

    /// What was commanded since the last mark, or the start, was this pass. Marks before any start count nothing.
    void mark(const char* pass);

    /// Waits for the GPU. Each pass and its seconds, in order; then nothing is timed until the next start.
    std::vector<std::pair<std::string, double>> stop();

  private:
    void stamp();

    std::vector<GlQuery> queries_; ///< as many as were ever needed
    std::vector<std::string> passes_;
    bool runs_ = false;
};

} // namespace lockstep
