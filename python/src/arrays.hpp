/// Arguments of Python as arrays of doubles, and NumPy's rules of broadcasting.
#pragma once

#include <Python.h>
#include <nanobind/nanobind.h>
#include <nanobind/stl/string.h>

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "hts/error.hpp"

namespace hts::python {

namespace nb = nanobind;

/// Lengths of the axes of an array, the last one running fastest.
using Shape = std::vector<std::ptrdiff_t>;

[[nodiscard]] std::size_t size_of(const Shape& shape) noexcept;
/// "(3, 4)", as Python writes it.
[[nodiscard]] std::string text_of(const Shape& shape);
/// "(3, 2)", or "3" along one axis: where the i-th element is.
[[nodiscard]] std::string index_text(std::size_t i, const Shape& shape);

/// What f returns; its error says of which element it is, where there are several.
///   i      of the element, once f has ended
///   what   the elements are
template <class Function>
auto of_element(const Shape& shape, const std::size_t& i, const Function& f, const char* what = "element") {
    try {
        return f();
    } catch (const Error& error) {
        if (size_of(shape) == 1) throw;
        throw Error{std::string{error.what()} + " (" + what + " " + index_text(i, shape) + ")"};
    }
}

/// An argument: real numbers of any shape, type and stride. Holds the array it looks at.
class Operand {
  public:
    /// One number.
    Operand(std::string name, double value);
    /// Whatever numpy.asarray makes an array of real numbers; hts::Error that names the argument otherwise.
    ///   last_axis   length that the last axis has to have, which then is no axis of the operand but holds
    ///               the components of one value; 0 for none
    Operand(std::string name, nb::handle value, std::ptrdiff_t last_axis = 0);
    Operand(Operand&& other) noexcept;
    Operand& operator=(Operand&&) = delete;
    ~Operand();

    [[nodiscard]] const std::string& name() const noexcept { return name_; }
    [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
    /// In elements.
    [[nodiscard]] const Shape& strides() const noexcept { return strides_; }
    [[nodiscard]] const double* data() const noexcept { return view_ ? data_ : &number_; }
    /// Whether its bytes and those of another array overlap, or lie between one another.
    [[nodiscard]] bool may_share_memory(const Py_buffer& view) const;
    /// Between the components of a value, in elements.
    [[nodiscard]] std::ptrdiff_t component_stride() const noexcept { return component_stride_; }

  private:
    std::string name_;
    double number_ = 0;
    std::optional<Py_buffer> view_;
    const double* data_ = nullptr;
    Shape shape_, strides_;
    std::ptrdiff_t component_stride_ = 0;
};

/// The common shape of operands, and where each has its value of an element.
class Broadcast {
  public:
    /// hts::Error that names shapes which do not go together.
    explicit Broadcast(std::span<const Operand* const> operands);

    [[nodiscard]] const Shape& shape() const noexcept { return shape_; }
    [[nodiscard]] std::size_t size() const noexcept { return size_of(shape_); }
    /// Steps of an operand along the common axes; 0 where it is the same all along.
    [[nodiscard]] Shape steps(const Operand& operand) const;

  private:
    Shape shape_;
};

/// Runs through some axes of a shape in order, and adds up the steps of several arrays.
class Walk {
  public:
    /// Over the axes whose flag is set.
    Walk(const Shape& shape, const std::vector<bool>& axes);

    [[nodiscard]] std::size_t size() const noexcept { return size_; }
    /// Offset of the i-th element in an array with these steps along all axes of the shape.
    [[nodiscard]] std::ptrdiff_t offset(std::size_t i, const Shape& steps) const noexcept;
    /// Offsets of elements first, first + 1, …
    void offsets(std::size_t first, const Shape& steps, std::span<std::ptrdiff_t> result) const noexcept;
    /// Their values in an array.
    void values(std::size_t first, const Shape& steps, const double* data,
                std::span<double> result) const noexcept;

  private:
    /// f(i, number, offset, step): results i, i + 1, … are of equal steps.
    template <class Function>
    void runs(std::size_t first, const Shape& steps, std::size_t number, const Function& f) const;

    std::vector<std::size_t> axes_;
    Shape lengths_;
    std::size_t size_ = 1;
};

/// Where results go: a new array, or the one that a caller gave.
class Result {
  public:
    ///   shape   of the result; where `out` is given, its own, else hts::Error
    ///   out     None, or an array of float64 that may be written
    ///   inputs  what must not change before it is read: where `out` shares memory with one of them, results
    ///           wait in a new array
    ///   together   how many of the last axes hold the values of one element, which then lie side by side
    Result(const Shape& shape, nb::object out, std::span<const Operand* const> inputs,
           std::size_t together = 0);
    ~Result();
    Result(const Result&) = delete;
    Result& operator=(const Result&) = delete;

    [[nodiscard]] double* data() const noexcept { return static_cast<double*>(view_.buf); }
    [[nodiscard]] const Shape& strides() const noexcept { return strides_; }
    /// The array, or the number where the shape is that of one.
    [[nodiscard]] nb::object finish();

  private:
    nb::object out_, array_;
    Py_buffer view_{};
    Shape strides_;
    bool scalar_;
};

/// numpy itself.
[[nodiscard]] nb::module_ numpy();
/// A new array of float64.
[[nodiscard]] nb::object new_array(const Shape& shape);
/// A new one-dimensional array of these values.
[[nodiscard]] nb::object array_of(std::span<const double> values);

}  // namespace hts::python
