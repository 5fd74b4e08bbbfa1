#include "arrays.hpp"

#include <algorithm>
#include <cstring>

#include "hts/error.hpp"

namespace hts::python {
namespace {

constexpr std::ptrdiff_t bytes = sizeof(double);

/// An array of float64 in the machine's order of bytes, aligned.
nb::object as_doubles(const std::string& name, nb::handle value) {
    nb::object array;
    try {
        if (nb::hasattr(value, "mask") && nb::cast<bool>(numpy().attr("ma").attr("is_masked")(value)))
            throw Error{name + ": holds masked values: must be numbers alone"};
        array = numpy().attr("asarray")(value);
    } catch (nb::python_error& error) {
        throw Error{name + ": must be a number or an array of numbers: " + error.what()};
    }
    const auto kind = nb::cast<std::string>(array.attr("dtype").attr("kind"));
    if (std::string{"fiu"}.find(kind) == std::string::npos) {
        throw Error{name + ": must be real numbers, not " +
                    nb::cast<std::string>(array.attr("dtype").attr("name"))};
    }
    array = array.attr("astype")(numpy().attr("float64"), nb::arg("copy") = false);
    if (!nb::cast<bool>(array.attr("flags").attr("aligned"))) array = array.attr("copy")();
    return array;
}

/// The bytes between the first and the last of an array.
std::pair<const char*, const char*> extent(const Py_buffer& view) {
    const auto* first = static_cast<const char*>(view.buf);
    const auto* last = first + view.itemsize;
    for (int i = 0; i < view.ndim; ++i) {
        if (view.shape[i] == 0) return {first, first};
        const std::ptrdiff_t way = (view.shape[i] - 1) * view.strides[i];
        (way < 0 ? first : last) += way;
    }
    return {first, last};
}

}  // namespace

nb::module_ numpy() {
    return nb::module_::import_("numpy");
}

nb::object new_array(const Shape& shape) {
    nb::list lengths;
    for (const std::ptrdiff_t length : shape) lengths.append(length);
    return numpy().attr("empty")(nb::tuple(lengths));
}

nb::object array_of(std::span<const double> values) {
    nb::object array = new_array({static_cast<std::ptrdiff_t>(values.size())});
    Py_buffer view;
    if (PyObject_GetBuffer(array.ptr(), &view, PyBUF_WRITABLE) != 0) throw nb::python_error();
    std::copy(values.begin(), values.end(), static_cast<double*>(view.buf));
    PyBuffer_Release(&view);
    return array;
}

std::size_t size_of(const Shape& shape) noexcept {
    std::size_t size = 1;
    for (const std::ptrdiff_t length : shape) size *= static_cast<std::size_t>(length);
    return size;
}

std::string text_of(const Shape& shape) {
    std::string text = "(";
    for (std::size_t i = 0; i < shape.size(); ++i) text += (i == 0 ? "" : ", ") + std::to_string(shape[i]);
    return text + (shape.size() == 1 ? ",)" : ")");
}

std::string index_text(std::size_t i, const Shape& shape) {
    Shape index(shape.size());
    for (std::size_t axis = shape.size(); axis-- > 0;) {
        const auto length = static_cast<std::size_t>(shape[axis]);
        index[axis] = static_cast<std::ptrdiff_t>(i % length);
        i /= length;
    }
    return index.size() == 1 ? std::to_string(index[0]) : text_of(index);
}

Operand::Operand(std::string name, double value) : name_{std::move(name)}, number_{value} {}

Operand::Operand(std::string name, nb::handle value, std::ptrdiff_t last_axis) : name_{std::move(name)} {
    if (last_axis == 0 && PyFloat_Check(value.ptr())) {
        number_ = PyFloat_AsDouble(value.ptr());
        return;
    }
    const nb::object array = as_doubles(name_, value);
    Py_buffer view;
    if (PyObject_GetBuffer(array.ptr(), &view, PyBUF_STRIDES | PyBUF_FORMAT) != 0) throw nb::python_error();
    view_ = view;  // holds the array
    data_ = static_cast<const double*>(view.buf);
    bool whole_steps = true;
    for (int i = 0; i < view.ndim; ++i) {
        shape_.push_back(view.shape[i]);
        whole_steps = whole_steps && view.strides[i] % bytes == 0;
        strides_.push_back(view.strides[i] / bytes);
    }
    if (!whole_steps) {  // a field of a structured array
        PyBuffer_Release(&*view_);
        view_.reset();
        const nb::object copy = array.attr("copy")();
        if (PyObject_GetBuffer(copy.ptr(), &view, PyBUF_STRIDES | PyBUF_FORMAT) != 0)
            throw nb::python_error();
        view_ = view;
        data_ = static_cast<const double*>(view.buf);
        for (std::size_t i = 0; i < strides_.size(); ++i) strides_[i] = view.strides[i] / bytes;
    }
    if (last_axis == 0) return;
    if (shape_.empty() || shape_.back() != last_axis) {
        const std::string shape = text_of(shape_);
        PyBuffer_Release(&*view_);
        view_.reset();
        throw Error{name_ + ": must be of shape (..., " + std::to_string(last_axis) + "), not " + shape};
    }
    component_stride_ = strides_.back();
    shape_.pop_back();
    strides_.pop_back();
}

Operand::Operand(Operand&& other) noexcept
    : name_{std::move(other.name_)},
      number_{other.number_},
      view_{std::exchange(other.view_, std::nullopt)},
      data_{other.data_},
      shape_{std::move(other.shape_)},
      strides_{std::move(other.strides_)},
      component_stride_{other.component_stride_} {}

bool Operand::may_share_memory(const Py_buffer& view) const {
    if (!view_) return false;
    const auto [first, last] = extent(*view_);
    const auto [other_first, other_last] = extent(view);
    return first < other_last && other_first < last;
}

Operand::~Operand() {
    if (view_) PyBuffer_Release(&*view_);
}

Broadcast::Broadcast(std::span<const Operand* const> operands) {
    for (const Operand* operand : operands) {
        const Shape& own = operand->shape();
        if (own.size() > shape_.size()) shape_.insert(shape_.begin(), own.size() - shape_.size(), 1);
        const std::size_t skipped = shape_.size() - own.size();
        for (std::size_t i = 0; i < own.size(); ++i) {
            std::ptrdiff_t& common = shape_[skipped + i];
            if (common == own[i] || own[i] == 1) continue;
            if (common != 1) {
                std::string shapes;
                for (const Operand* each : operands) {
                    if (each->shape().empty()) continue;
                    shapes += (shapes.empty() ? "" : ", ") + each->name() + " " + text_of(each->shape());
                }
                throw Error{"shapes do not broadcast together: " + shapes};
            }
            common = own[i];
        }
    }
}

Shape Broadcast::steps(const Operand& operand) const {
    Shape steps(shape_.size(), 0);
    const std::size_t skipped = shape_.size() - operand.shape().size();
    for (std::size_t i = 0; i < operand.shape().size(); ++i) {
        if (operand.shape()[i] != 1) steps[skipped + i] = operand.strides()[i];
    }
    return steps;
}

Walk::Walk(const Shape& shape, const std::vector<bool>& axes) {
    for (std::size_t i = 0; i < shape.size(); ++i) {
        if (!axes[i] || shape[i] == 1) continue;
        axes_.push_back(i);
        lengths_.push_back(shape[i]);
    }
    size_ = size_of(lengths_);
}

std::ptrdiff_t Walk::offset(std::size_t i, const Shape& steps) const noexcept {
    std::ptrdiff_t offset = 0;
    for (std::size_t axis = axes_.size(); axis-- > 0;) {
        const auto length = static_cast<std::size_t>(lengths_[axis]);
        offset += static_cast<std::ptrdiff_t>(i % length) * steps[axes_[axis]];
        i /= length;
    }
    return offset;
}

template <class Function>
void Walk::runs(std::size_t first, const Shape& steps, std::size_t number, const Function& f) const {
    // along the last axis as far as it goes
    const std::size_t length = axes_.empty() ? 1 : static_cast<std::size_t>(lengths_.back());
    const std::ptrdiff_t step = axes_.empty() ? 0 : steps[axes_.back()];
    for (std::size_t i = 0; i < number;) {
        const std::size_t run = std::min(length - (first + i) % length, number - i);
        f(i, run, offset(first + i, steps), step);
        i += run;
    }
}

void Walk::offsets(std::size_t first, const Shape& steps, std::span<std::ptrdiff_t> result) const noexcept {
    runs(first, steps, result.size(),
         [&](std::size_t i, std::size_t number, std::ptrdiff_t begin, std::ptrdiff_t step) {
             for (std::size_t j = 0; j < number; ++j)
                 result[i + j] = begin + static_cast<std::ptrdiff_t>(j) * step;
         });
}

void Walk::values(std::size_t first, const Shape& steps, const double* data,
                  std::span<double> result) const noexcept {
    runs(first, steps, result.size(),
         [&](std::size_t i, std::size_t number, std::ptrdiff_t begin, std::ptrdiff_t step) {
             const double* from = data + begin;
             for (std::size_t j = 0; j < number; ++j, from += step) result[i + j] = *from;
         });
}

Result::Result(const Shape& shape, nb::object out, std::span<const Operand* const> inputs,
               std::size_t together)
    : out_{std::move(out)}, scalar_{shape.empty() && out_.is_none()} {
    if (!out_.is_none()) {
        if (!nb::isinstance(out_, numpy().attr("ndarray")) ||
            !nb::cast<bool>(out_.attr("dtype").attr("__eq__")(numpy().attr("dtype")("float64")))) {
            throw Error{"out: must be an array of float64"};
        }
        if (!nb::cast<bool>(out_.attr("flags").attr("writeable")))
            throw Error{"out: is read-only: must be writable"};
    }
    array_ = out_;
    const auto take = [&] {
        if (PyObject_GetBuffer(array_.ptr(), &view_, PyBUF_STRIDES | PyBUF_WRITABLE) != 0)
            throw nb::python_error();
    };
    if (!out_.is_none()) {
        take();
        const Shape own(view_.shape, view_.shape + view_.ndim);
        bool direct = nb::cast<bool>(out_.attr("flags").attr("aligned"));
        for (int i = 0; i < view_.ndim; ++i) direct = direct && view_.strides[i] % bytes == 0;
        std::ptrdiff_t side_by_side = bytes;
        for (std::size_t i = own.size(); i-- > 0 && own.size() - i <= together; side_by_side *= own[i])
            direct = direct && view_.strides[i] == side_by_side;
        // new memory unless nothing that is still to be read can be written over
        for (const Operand* input : inputs) direct = direct && !input->may_share_memory(view_);
        PyBuffer_Release(&view_);
        view_ = {};
        if (own != shape) throw Error{"out: must be of shape " + text_of(shape) + ", not " + text_of(own)};
        if (!direct) array_ = new_array(shape);
    } else {
        array_ = new_array(shape);
    }
    take();
    for (int i = 0; i < view_.ndim; ++i) strides_.push_back(view_.strides[i] / bytes);
}

Result::~Result() {
    if (view_.obj != nullptr) PyBuffer_Release(&view_);
}

nb::object Result::finish() {
    const double first = scalar_ ? *data() : 0;
    PyBuffer_Release(&view_);
    view_ = {};
    if (scalar_) return nb::float_(first);
    if (!out_.is_none() && !array_.is(out_)) numpy().attr("copyto")(out_, array_);
    return out_.is_none() ? array_ : out_;
}

}  // namespace hts::python
