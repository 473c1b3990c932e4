#pragma once
#include <cstdlib>
#include <initializer_list>
#include <string>
#include <vector>

#include <dlfcn.h>
#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

/// A library opened at run time. It stays open for the life of the process: drivers keep threads and exit handlers.
class SharedLibrary {
  public:
    /// Opens the file the environment variable `chooser` names, so that a user can take another build; without it the
    /// first of `names` there is. Throws Error with the loader's reason for each.
    SharedLibrary(const char* chooser, std::initializer_list<const char*> names) {
        const char* chosen = std::getenv(chooser);
        const bool choose = chosen != nullptr && *chosen != '\0';
        std::string reasons;
        for (const char* name : choose ? std::vector{chosen} : std::vector(names)) {
            handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
            if (handle_ != nullptr) {
                name_ = name;
                return;
            }
            reasons += fmt::format("{}{}", reasons.empty() ? "" : ", ", why_not(name));
        }
        throw Error(fmt::format("{} ({} can name another library)", reasons, chooser));
    }

    /// Throws Error if the library lacks `name`.
    template <class Function> void get(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(dlsym(handle_, name));
        if (function == nullptr)
            throw Error(fmt::format("{} lacks {}", name_, name));
    }

    /// " (NAME: why it does not load)" for each of `names` that is on the machine and does not; empty if there is none.
    static std::string broken(std::initializer_list<const char*> names) {
        std::string reasons;
        for (const char* name : names) {
            if (dlopen(name, RTLD_NOW | RTLD_LOCAL) != nullptr)
                continue;
            const std::string reason = why_not(name);
            if (!reason.starts_with(fmt::format("{}: cannot open shared object file", name)))
                reasons += fmt::format(" ({})", reason);
        }
        return reasons;
    }

  private:
    /// Why the loader has just not opened `name`, which it names first, but for a library that `name` needs.
    static std::string why_not(const std::string& name) {
        const char* error = dlerror();
        const std::string reason = error != nullptr ? error : "cannot be opened";
        return reason.starts_with(name) ? reason : fmt::format("{}: {}", name, reason);
    }

    void* handle_ = nullptr;
    std::string name_;
};

} // namespace lockstep
