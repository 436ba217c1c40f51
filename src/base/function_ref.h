// A callable passed by reference, without copy or allocation.
#pragma once

#include <memory>
#include <type_traits>
#include <utility>

namespace scarp {

template <class Signature>
class FunctionRef;

/// Borrows the callable that it was constructed from. A parameter of this type accepts any callable, as std::function
/// does. Its size is two pointers.
template <class Result, class... Arguments>
class FunctionRef<Result(Arguments...)> {
 public:
  template <class Callee>
  requires(!std::is_same_v<std::remove_cvref_t<Callee>, FunctionRef> &&
           std::is_invocable_r_v<Result, Callee&, Arguments...>)
      FunctionRef(Callee&& callee)  // NOLINT(google-explicit-constructor): like std::function
      : callee_(const_cast<void*>(static_cast<const void*>(std::addressof(callee)))),
        call_([](void* made_of, Arguments... arguments) -> Result {
          return static_cast<Result>(
              (*static_cast<std::remove_reference_t<Callee>*>(made_of))(std::forward<Arguments>(arguments)...));
        }) {}

  Result operator()(Arguments... arguments) const { return call_(callee_, std::forward<Arguments>(arguments)...); }

 private:
  void* callee_;
  Result (*call_)(void*, Arguments...);
};

}  // namespace scarp
