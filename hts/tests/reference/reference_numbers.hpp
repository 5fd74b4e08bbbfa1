// Numbers for the reference generator: 80-digit reals, complex numbers, vectors, reproducible random draws
// and CSV tables. Nothing here is shared with the engine.
#pragma once

#include <array>
#include <boost/math/constants/constants.hpp>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

namespace reference {

/// 80 decimal digits. The worst loss in the formulas below is about 20 digits (the exponent of Phi at
/// g = 1e10, Lambda at large c), so 55 or more digits remain everywhere and 25 are written.
using Real =
    boost::multiprecision::number<boost::multiprecision::cpp_bin_float<80>, boost::multiprecision::et_off>;

inline const Real pi = boost::math::constants::pi<Real>();

/// The angle in radians of a decimal number of degrees that was read as a double.
inline Real radians(double degrees) {
    return Real(degrees) * pi / 180;
}
inline Real radians(const Real& degrees) {
    return degrees * pi / 180;
}

// ---------------------------------------------------------------------------------------- complex numbers

/// Our own, because std::complex is unspecified for types other than float, double and long double.
struct Complex {
    Real re{0}, im{0};
};

inline Complex operator+(const Complex& a, const Complex& b) {
    return {a.re + b.re, a.im + b.im};
}
inline Complex operator-(const Complex& a, const Complex& b) {
    return {a.re - b.re, a.im - b.im};
}
inline Complex operator*(const Complex& a, const Complex& b) {
    return {a.re * b.re - a.im * b.im, a.re * b.im + a.im * b.re};
}
inline Complex operator*(const Real& a, const Complex& b) {
    return {a * b.re, a * b.im};
}
inline Complex conj(const Complex& a) {
    return {a.re, -a.im};
}
inline Real norm(const Complex& a) {
    return a.re * a.re + a.im * a.im;
}
inline Complex operator/(const Complex& a, const Complex& b) {
    return 1 / norm(b) * (a * conj(b));
}

/// Principal root of a number with im >= 0: both parts of the root are >= 0. The larger part comes from the
/// half-angle formula, the other from re * im = a.im / 2, so that neither cancels.
inline Complex sqrt(const Complex& a) {
    const Real modulus = sqrt(norm(a));
    if (modulus == 0) return {};
    const Real larger = sqrt((modulus + abs(a.re)) / 2);
    const Real smaller = a.im / (2 * larger);
    return a.re >= 0 ? Complex{larger, smaller} : Complex{smaller, larger};
}

// ------------------------------------------------------------------------------------------------ vectors

struct Vector {
    Real x{0}, y{0}, z{0};
};

inline Vector operator-(const Vector& a, const Vector& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vector operator-(const Vector& a) {
    return {-a.x, -a.y, -a.z};
}
inline Vector operator/(const Vector& a, const Real& b) {
    return {a.x / b, a.y / b, a.z / b};
}
inline Real dot(const Vector& a, const Vector& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Real length(const Vector& a) {
    return sqrt(dot(a, a));
}
inline Vector cross(const Vector& a, const Vector& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Unit vector with polar angle theta from the outward normal z and azimuth phi [rad].
inline Vector direction(const Real& theta, const Real& phi) {
    return {sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta)};
}

// -------------------------------------------------------------------------------------------------- draws

/// Draws that are the same bits everywhere: the standard fixes std::mt19937_64, and everything computed from
/// its bits goes through Real and is rounded to double once (no libm, no fused multiply-add).
class Draw {
  public:
    explicit Draw(std::uint64_t seed) : bits_(seed) {}

    Real unit() { return Real(bits_() >> 11) / Real(std::uint64_t{1} << 53); }
    double uniform(double low, double high) {
        return static_cast<double>(Real(low) + (Real(high) - Real(low)) * unit());
    }
    double log_uniform(double low, double high) {
        return static_cast<double>(exp(log(Real(low)) + log(Real(high) / Real(low)) * unit()));
    }
    double signed_log_uniform(double low, double high) {
        const double sign = chance(0.5) ? 1 : -1;
        return sign * log_uniform(low, high);
    }
    bool chance(double probability) { return unit() < Real(probability); }

  private:
    std::mt19937_64 bits_;
};

// ------------------------------------------------------------------------------------------------- tables

/// An input: 17 significant digits, which give the double back exactly.
inline std::string text(double input) {
    std::array<char, 40> buffer{};
    static_cast<void>(std::snprintf(buffer.data(), buffer.size(), "%.17g", input));
    return buffer.data();
}

/// A reference value: 25 significant digits in scientific notation, or 0.
inline std::string text(const Real& value) {
    return value == 0 ? std::string("0") : value.str(24, std::ios_base::scientific);
}

/// A CSV file: comment lines, a header, rows of the header's width.
class Table {
  public:
    Table(const std::string& path, const std::vector<std::string>& comments, const std::string& header,
          const std::string& generator = "generate_reference")
        : path_(path), file_(path) {
        for (const std::string& line : comments) file_ << "# " << line << '\n';
        file_ << "# made by: " << generator << " FOLDER (hts/tests/reference/" << generator << ".cpp)\n";
        file_ << header << '\n';
    }
    void add(const std::vector<std::string>& cells) {
        for (std::size_t i = 0; i < cells.size(); ++i) file_ << (i == 0 ? "" : ",") << cells[i];
        file_ << '\n';
    }
    void close() {
        file_.close();
        if (!file_) throw std::runtime_error(path_ + ": cannot be written");
    }

  private:
    std::string path_;
    std::ofstream file_;
};

}  // namespace reference
