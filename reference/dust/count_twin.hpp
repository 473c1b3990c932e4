#pragma once
#include <cstddef>
#include <tuple>

#include "reference/dust/sites.hpp"
#include "reference/model/dust/schema.hpp"
#include "reference/system/item_pass.hpp"

namespace lockstep::dust {

/// After every kernel the count is the number of grains that are alive.
struct CountTwin {
    template <class R> struct Count {
        typename R::Int number{};
        auto fields() const { return std::tie(number); }
    };

    template <class R> Count<R> operator()(R& r, const PassInput& in, std::size_t item) const {
        const int before = in.before.integer(field::alive_number, item);
        const auto living = static_cast<int>(in.before.total(field::alive));
        const auto change =
            r.note(site::change, typename R::Int(r.note(site::living, typename R::Int(living)) - before));
        return {r.note(site::count, typename R::Int(change + before))};
    }
};

} // namespace lockstep::dust
