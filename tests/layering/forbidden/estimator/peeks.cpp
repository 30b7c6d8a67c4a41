#include "model/truth.hpp"
