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
    /// first of `names` there is. Throws Error with the loader's reason.
    SharedLibrary(const char* chooser, std::initializer_list<const char*> names) {
        const char* chosen = std::getenv(chooser);
        const bool choose = chosen != nullptr && *chosen != '\0';
        std::string reason;
        for (const char* name : choose ? std::vector{chosen} : std::vector(names)) {
            handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
            if (handle_ != nullptr) {
                name_ = name;
                return;
            }
            if (const char* error = dlerror(); reason.empty() && error != nullptr)
                reason = error;
        }
        throw Error(fmt::format("{} ({} can name another library)", reason, chooser));
    }

    /// Throws Error if the library lacks `name`.
    template <class Function> void get(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(dlsym(handle_, name));
        if (function == nullptr)
            throw Error(fmt::format("{} lacks {}", name_, name));
    }

  private:
    void* handle_ = nullptr;
    std::string name_;
};

} // namespace lockstep
