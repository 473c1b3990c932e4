#pragma once
#include <initializer_list>
#include <string>

#include <dlfcn.h>
#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep {

/// A library opened at run time. It stays open for the life of the process: drivers keep threads and exit handlers.
class SharedLibrary {
  public:
    /// Opens the first of `names` there is. Throws Error with the loader's reason for the first of them.
    explicit SharedLibrary(std::initializer_list<const char*> names) {
        std::string reason;
        for (const char* name : names) {
            handle_ = dlopen(name, RTLD_NOW | RTLD_LOCAL);
            if (handle_ != nullptr)
                return;
            if (const char* error = dlerror(); reason.empty() && error != nullptr)
                reason = error;
        }
        throw Error(reason);
    }

    /// Throws Error if the library lacks `name`.
    template <class Function> void get(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(dlsym(handle_, name));
        if (function == nullptr)
            throw Error(fmt::format("the library lacks {}", name));
    }

  private:
    void* handle_ = nullptr;
};

} // namespace lockstep
