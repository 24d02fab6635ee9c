// PETSc's time steppers of the types seisav, seilm, egc4, …: every method of methods() by its name.
#pragma once

#include <petscts.h>

// Registers them with PETSc, once; -dll_append with the path of libseiche_ts.so does so without a line of code.
extern "C" PetscErrorCode TSSeicheRegisterAll(void);
extern "C" PetscErrorCode PetscDLLibraryRegister_seiche_ts(void);
