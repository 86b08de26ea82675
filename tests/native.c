/* native.c: wide and predicate as the library is built, behind the backend interface. */
#include "backend.h"

#include <stddef.h>

#define BACKEND native
#include "backend_body.h"
