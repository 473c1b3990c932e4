#include "gpu/probe/constant_divisors.hpp"

namespace lockstep::probing {

ProbeRow judge_constant_divisors(const std::string& name, const DriverArithmetic& vertex, const Floats& dividends,
                                 const Floats& values) {
    Floats divisors, products;
    for (std::size_t i = 0; i < dividends.size(); ++i) {
        const float c = constant_divisors[i % constant_divisors.size()];
        divisors.push_back(c);
        products.push_back(dividends[i] * (1.0F / c));
    }
    return judge(name, values, {{"as a/b", vertex.divide(dividends, divisors)}, {"a*(1/c), 1/c rounded", products}});
}

} // namespace lockstep::probing
