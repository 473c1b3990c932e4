#include "gpu/pass_timer.hpp"

#include <cstdint>

namespace lockstep {
namespace {

void begin_queries() {
    if (gl::MemoryBarrier != nullptr)
        gl::MemoryBarrier(GL_ALL_BARRIER_BITS);
}

std::uint64_t nanoseconds_of(const GlQuery& query) {
    GLuint64 nanoseconds = 0;
    gl::GetQueryObjectui64v(query.id(), GL_QUERY_RESULT, &nanoseconds);
    return nanoseconds;
}

} // namespace

RunningTimer::RunningTimer(const GlQuery& query) : query_(GL_TIME_ELAPSED, query) { begin_queries(); }

double seconds_of(const GlQuery& query) { return static_cast<double>(nanoseconds_of(query)) * 1e-9; }

void PassTimer::stamp() {
    if (queries_.size() <= passes_.size())
        queries_.emplace_back();
    gl::QueryCounter(queries_[passes_.size()].id(), GL_TIMESTAMP);
    begin_queries();
}

void PassTimer::start() {
    passes_.clear();
    runs_ = true;
    stamp();
}

void PassTimer::mark(const char* pass) {
    if (!runs_)
        return;
    passes_.emplace_back(pass);
    stamp();
}

std::vector<std::pair<std::string, double>> PassTimer::stop() {
    std::vector<std::pair<std::string, double>> seconds;
    std::uint64_t before = nanoseconds_of(queries_.front());
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        const std::uint64_t after = nanoseconds_of(queries_[p + 1]);
        seconds.emplace_back(std::move(passes_[p]), static_cast<double>(after - before) * 1e-9);
        before = after;
    }
    passes_.clear();
    runs_ = false;
    return seconds;
}

} // namespace lockstep
