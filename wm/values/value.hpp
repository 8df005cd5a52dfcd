#pragma once

#include "castor/wm/values/descriptor_of.hpp"
#include "castor/wm/values/encoded_size.hpp"
#include "castor/wm/values/encoding.hpp"
#include "castor/wm/values/field_access.hpp"
#include "castor/wm/values/field_mask.hpp"
#include "castor/wm/values/object_access.hpp"
#include "castor/wm/values/wire_equality.hpp"

#include <atomic>
#include <memory>
#include <mutex>
#include <span>
#include <typeinfo>
#include <utility>
#include <vector>

namespace castor {

/// The content of an entry: immutable, shared, of any reflected type.
///
/// Copies share one object, so within a process a value is never copied deeply and never changes.
/// The object and what the value knows of it are one piece of memory. It is encoded once, on the
/// first access to its bytes; a value that arrived as bytes is decoded once, on the first access to
/// its C++ type. Thread-safe.
class Value {
public:
  /// An empty value: only `has_value()` may be called.
  Value() = default;

  template <ReflectedRecord T>
  static Value of(T x) {
    auto rep = std::make_shared<ObjectRep<T>>(std::move(x));
    rep->type = descriptor_of<T>();
    rep->object = &rep->value;
    rep->operations = type_operations<T>();
    return Value{std::move(rep)};
  }

  /// A value from its wire form; the process need not have its C++ type.
  static Value from_bytes(TypeDescriptorPtr type, Bytes bytes);

  /// The same for untrusted bytes: throws DecodeError if they are not a value of the type.
  static Value from_foreign_bytes(TypeDescriptorPtr type, Bytes bytes);

  bool has_value() const { return rep_ != nullptr; }
  const TypeDescriptor& type() const { return *rep_->type; }
  const TypeDescriptorPtr& type_ptr() const { return rep_->type; }
  const std::string& type_name() const { return rep_->type->name(); }

  /// Refers to what all copies of the value share, and does not keep it.
  std::weak_ptr<const void> weak() const { return rep_; }

  /// The wire form.
  const Bytes& bytes() const;

  /// Size of the wire form, without encoding.
  std::size_t encoded_size() const;

  /// The single field at a place of the value's type (`find_field`); read from the object if there
  /// is one. Throws DecodeError if the value came as bytes that do not fit its type.
  FieldValue field(const FieldPath& path) const;

  /// Whether no optional on the way to a place, nor the field itself, is empty. Throws as `field`.
  bool has_field(const FieldPath& path) const;

  /// The object, if the value is a `T` or derives from it; otherwise null. Throws DecodeError if
  /// the value came as bytes that do not fit `T`.
  template <ReflectedRecord T>
  std::shared_ptr<const T> as() const {
    auto& wanted = *descriptor_of<T>();
    if (!type().is_a(wanted.name()))
      return nullptr;
    if (rep_->operations)
      if (auto* object = rep_->operations->upcast(rep_->object, typeid(T)))
        return {rep_, static_cast<const T*>(object)};
    return decoded<T>(wanted);
  }

  /// Whether two values have the same type and the same wire form.
  friend bool operator==(const Value& a, const Value& b);

  /// The fields whose wire forms differ between two values of one type (two objects are compared
  /// without encoding); all fields for values of different types. Throws DecodeError if a value
  /// came as bytes that do not fit its type.
  friend FieldMask changed_fields(const Value& before, const Value& after);

private:
  struct Operations {
    /// The `T` inside the object, or null if the object has no such base.
    const void* (*upcast)(const void* object, const std::type_info& wanted);
    Bytes (*encode)(const void* object);
    std::size_t (*encoded_size)(const void* object);
    FieldMask (*differ)(const void* a, const void* b);
    /// Access to the fields.
    const ObjectOperations* parts;
  };

  /// The other forms of a value, which few values have.
  struct OtherForms {
    std::once_flag encode_once;
    Bytes bytes;
    /// Objects decoded from `bytes`: of the type itself or its bases, each at most once.
    std::mutex decode_mutex;
    std::vector<std::pair<const std::type_info*, std::shared_ptr<const void>>> decoded;
  };

  struct Rep {
    Rep() = default;
    Rep(const Rep&) = delete;
    Rep& operator=(const Rep&) = delete;
    ~Rep() { delete forms.load(std::memory_order_acquire); }

    TypeDescriptorPtr type;
    /// The object and its operations; null for a value that came as bytes.
    const void* object = nullptr;
    const Operations* operations = nullptr;
    /// Null until somebody wants one of them.
    std::atomic<OtherForms*> forms{nullptr};
  };

  template <class T>
  struct ObjectRep : Rep {
    explicit ObjectRep(T x) : value(std::move(x)) {}

    const T value;
  };

  explicit Value(std::shared_ptr<Rep> rep) : rep_(std::move(rep)) {}

  OtherForms& other_forms() const;

  template <ReflectedRecord T>
  static const void* upcast(const void* object, const std::type_info& wanted) {
    auto* x = static_cast<const T*>(object);
    if (wanted == typeid(T))
      return x;
    using Base = typename decltype(reflection_of<T>())::BaseType;
    if constexpr (!std::is_void_v<Base>)
      return upcast<Base>(static_cast<const Base*>(x), wanted);
    else
      return nullptr;
  }

  template <ReflectedRecord T>
  static const Operations* type_operations() {
    static constexpr Operations result{
      &upcast<T>, [](const void* object) { return encode(*static_cast<const T*>(object)); },
      [](const void* object) { return castor::encoded_size(*static_cast<const T*>(object)); },
      [](const void* a, const void* b) {
        return fields_that_differ(*static_cast<const T*>(a), *static_cast<const T*>(b));
      },
      &detail::object_operations<T>};
    return &result;
  }

  ObjectPart part(const FieldPath& path) const {
    return find_part({rep_->object, rep_->operations->parts}, path);
  }

  /// Throws DecodeError if this process has a different type with the name of the value's type or
  /// base.
  void check_same_layout(const TypeDescriptor& wanted) const;

  template <ReflectedRecord T>
  std::shared_ptr<const T> decoded(const TypeDescriptor& wanted) const {
    auto& forms = other_forms();
    std::lock_guard guard{forms.decode_mutex};
    for (auto& [type, object] : forms.decoded)
      if (*type == typeid(T))
        return std::static_pointer_cast<const T>(object);
    check_same_layout(wanted);
    T object{};
    Decoder in{bytes()};
    in.get_fields(object);
    // Only a derived value has more fields than the requested type.
    if (type().name() == wanted.name())
      in.expect_end();
    auto result = std::make_shared<const T>(std::move(object));
    forms.decoded.emplace_back(&typeid(T), result);
    return result;
  }

  std::shared_ptr<Rep> rep_;
};

FieldMask changed_fields(const Value& before, const Value& after);

/// Wire form of descriptor and content together, for files and pipes.
Bytes encode_self_described(const Value& x);

/// Throws DecodeError.
Value decode_self_described(std::span<const std::uint8_t> bytes);

} // namespace castor
