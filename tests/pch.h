#include <gtest/gtest.h>

#include <Eigen/Dense>
