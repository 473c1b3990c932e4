#include "crosscheck/record/hdf5.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <string_view>

#include <fmt/format.h>

#include "reference/model/error.hpp"

namespace lockstep::hdf5 {
namespace {

/// The innermost reason on the library's error stack.
std::string reason() {
    std::string text;
    H5Ewalk2(
        H5E_DEFAULT, H5E_WALK_DOWNWARD,
        [](unsigned, const H5E_error2_t* error, void* into) -> herr_t {
            if (error->desc != nullptr)
                *static_cast<std::string*>(into) = error->desc;
            return 0;
        },
        &text);
    H5Eclear2(H5E_DEFAULT);
    // What the system said stands in the middle of a text about HDF5's insides.
    constexpr std::string_view before = "errno = ";
    if (const std::size_t at = text.find(before); at != std::string::npos)
        return std::strerror(std::atoi(text.c_str() + at + before.size()));
    std::replace(text.begin(), text.end(), '\n', ' ');
    return text.empty() ? "HDF5 gives no reason" : text;
}

} // namespace

Id::Id(hid_t id, Close close, const std::string& what) : id_(id), close_(close) {
    if (id < 0)
        throw Error(fmt::format("{}: {}", what, reason()));
}

Id::~Id() {
    if (id_ >= 0 && std::uncaught_exceptions() == 0)
        close_(id_);
}

void expect(herr_t status, const std::string& what) {
    if (status < 0)
        throw Error(fmt::format("{}: {}", what, reason()));
}

void quieten() {
    H5dont_atexit();
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

hid_t file_type(Scalar scalar) {
    return scalar == Scalar::float32 ? H5T_IEEE_F32LE : scalar == Scalar::int32 ? H5T_STD_I32LE : H5T_STD_U32LE;
}

hid_t memory_type(Scalar scalar) {
    return scalar == Scalar::float32 ? H5T_NATIVE_FLOAT
           : scalar == Scalar::int32 ? H5T_NATIVE_INT32
                                     : H5T_NATIVE_UINT32;
}

} // namespace lockstep::hdf5
