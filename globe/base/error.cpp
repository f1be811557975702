#include "globe/base/error.h"
