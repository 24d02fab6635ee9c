// Calls of PETSc from code that throws, and of such code from PETSc.
#pragma once

#include <seiche/core/base/error.hpp>

#include <petscsys.h>

#include <exception>
#include <string>

namespace seiche {

// A call that failed. PETSc's error handler has said why; the code goes on to whoever called us.
class PetscFailure : public std::exception {
 public:
  explicit PetscFailure(PetscErrorCode code) : code_(code) {}
  PetscErrorCode code() const { return code_; }
  const char* what() const noexcept override { return "a call of PETSc failed"; }

 private:
  PetscErrorCode code_;
};

// What PETSc has said of the last error, where a program of ours has loaded it; "" in a program of PETSc's, which is
// told by PETSc itself.
inline std::string& message_of_petsc() {
  static std::string message;
  return message;
}

inline void require(PetscErrorCode code) {
  if (code == 0) return;
  if (!message_of_petsc().empty()) throw Error("PETSc could not go on: {}", message_of_petsc());
  throw PetscFailure(code);
}

// What PETSc is to get of an action that may throw: 0, or the code of an error that its handler has been told.
template <class Action>
PetscErrorCode told_to_petsc(MPI_Comm communicator, const char* function, const Action& action) {
  try {
    action();
    return 0;
  } catch (const PetscFailure& failure) {
    return PetscError(communicator, __LINE__, function, "seiche/petsc", failure.code(), PETSC_ERROR_REPEAT, " ");
  } catch (const std::exception& error) {
    return PetscError(communicator, __LINE__, function, "seiche/petsc", PETSC_ERR_USER_INPUT, PETSC_ERROR_INITIAL, "%s",
                      error.what());
  }
}

// Destroys an object of PETSc, by its own function, with the handle.
template <class Object, PetscErrorCode (*destroy)(Object*)>
class PetscHandle {
 public:
  PetscHandle() = default;
  ~PetscHandle() { destroy(&object_); }
  PetscHandle(const PetscHandle&) = delete;
  PetscHandle& operator=(const PetscHandle&) = delete;

  operator Object() const { return object_; }
  void share(Object object) {  // which has other owners
    if (object != nullptr) require(PetscObjectReference(reinterpret_cast<PetscObject>(object)));
    require(destroy(&object_));
    object_ = object;
  }
  Object* make() {  // where a function of PETSc is to put a new one
    require(destroy(&object_));
    return &object_;
  }

 private:
  Object object_ = nullptr;
};

}  // namespace seiche
