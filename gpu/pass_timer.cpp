#include "gpu/pass_timer.hpp"

namespace lockstep {

void PassTimer::stamp() {
    if (queries_.size() <= passes_.size())
        queries_.emplace_back();
    gl::QueryCounter(queries_[passes_.size()].id(), GL_TIMESTAMP);
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
    GLuint64 before = 0;
    gl::GetQueryObjectui64v(queries_.front().id(), GL_QUERY_RESULT, &before);
    for (std::size_t p = 0; p < passes_.size(); ++p) {
        GLuint64 after = 0;
        gl::GetQueryObjectui64v(queries_[p + 1].id(), GL_QUERY_RESULT, &after);
        seconds.emplace_back(std::move(passes_[p]), static_cast<double>(after - before) * 1e-9);
        before = after;
    }
    passes_.clear();
    runs_ = false;
    return seconds;
}

} // namespace lockstep
