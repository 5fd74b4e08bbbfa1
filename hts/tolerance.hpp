/// How much relative error a caller accepts, so that the library can take the cheapest form that meets it.
#pragma once

namespace hts {

namespace accuracy {
inline constexpr double finest_tolerance = 1e-12;  ///< the least error that can be asked for
inline constexpr double coarsest_tolerance = 1;
inline constexpr double default_tolerance = 1e-6;  ///< vector lanes meet it, and no measurement asks for more
}  // namespace accuracy

/// The largest relative error a caller accepts; one meaning wherever it is an argument.
///
///     double coarse = hts::phi(g, t, hts::Tolerance{1e-3});
///
/// A request is met or refused at construction, never relaxed.
class Tolerance {
  public:
    /// accuracy::default_tolerance.
    constexpr Tolerance() noexcept : relative_error_{accuracy::default_tolerance} {}
    /// \param relative_error  accuracy::finest_tolerance ... accuracy::coarsest_tolerance   [1]
    /// \throws Error  naming the value and the legal range; in a constant expression it does not compile
    constexpr explicit Tolerance(double relative_error) : relative_error_{relative_error} {
        if (!(relative_error >= accuracy::finest_tolerance && relative_error <= accuracy::coarsest_tolerance))
            refuse(relative_error);
    }

    [[nodiscard]] constexpr double relative_error() const noexcept { return relative_error_; }

  private:
    [[noreturn]] static void refuse(double relative_error);

    double relative_error_;
};

}  // namespace hts
