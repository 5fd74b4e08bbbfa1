#include "hts/tolerance.hpp"

#include "hts/error.hpp"

namespace hts {

void Tolerance::refuse(double relative_error) {
    throw out_of_range("tolerance", relative_error, "", "a relative error from 1e-12 to 1");
}

}  // namespace hts
