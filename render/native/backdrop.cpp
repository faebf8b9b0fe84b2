#include "render/native/picture.h"
