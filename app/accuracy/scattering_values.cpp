// Written by globe_scattering_reference (tests/bench/scattering_reference.cpp).

#include "app/accuracy/scattering_cases.h"

namespace app::accuracy {

// clang-format off
// Light scattered once, light scattered again, half the width of the latter's 95 % confidence interval.
std::vector<ScatteredLight> scattering_values() {
  return {
      {{7.70799e-03, 1.31074e-02, 2.46843e-02}, {9.11048e-04, 2.60694e-03, 9.09090e-03}, {1.4e-05, 3.4e-05, 1.1e-04}},  // eye at 0.002 km, sun 60 deg high, look, deg 80, 0 deg from the sun
      {{6.94145e-03, 1.26392e-02, 2.17436e-02}, {1.12982e-03, 3.34941e-03, 1.13083e-02}, {3.3e-05, 6.4e-05, 2.1e-04}},  // eye at 0.002 km, sun 15 deg high, look, deg 30, 180 deg from the sun
      {{2.75720e-01, 7.51958e-02, 5.44906e-03}, {9.94908e-03, 7.35748e-03, 6.00484e-03}, {4.0e-04, 1.4e-04, 1.1e-04}},  // eye at 0.002 km, sun 2 deg high, look, deg 1, 0 deg from the sun
      {{5.13555e-03, 3.35841e-03, 2.25745e-03}, {9.54526e-04, 1.27032e-03, 2.52786e-03}, {2.2e-05, 2.3e-05, 4.8e-05}},  // eye at 0.002 km, sun 0 deg high, look, deg 10, 90 deg from the sun
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {2.33437e-04, 1.70840e-04, 3.21419e-04}, {4.2e-06, 2.5e-06, 4.6e-06}},  // eye at 0.002 km, sun -3 deg high, look, deg 0.3, 180 deg from the sun
      {{4.87041e-04, 1.36864e-04, 4.21669e-05}, {6.76231e-05, 3.60950e-05, 4.59713e-05}, {2.2e-06, 8.3e-07, 9.6e-07}},  // eye at 0.002 km, sun -6 deg high, look, deg 3, 45 deg from the sun
      {{5.17957e-03, 1.07764e-02, 2.32362e-02}, {8.38692e-04, 2.48186e-03, 9.09062e-03}, {1.9e-05, 3.9e-05, 1.3e-04}},  // eye at 3 km, sun 60 deg high, look, deg 45, 20 deg from the sun
      {{2.04596e-03, 4.04461e-03, 8.44060e-03}, {3.13093e-04, 1.01304e-03, 4.07393e-03}, {5.4e-06, 1.3e-05, 6.3e-05}},  // eye at 3 km, sun 15 deg high, look, deg 80, 0 deg from the sun
      {{4.15555e-03, 5.15472e-03, 7.72110e-03}, {3.63636e-04, 7.94208e-04, 2.47654e-03}, {1.0e-05, 1.4e-05, 4.7e-05}},  // eye at 3 km, sun 2 deg high, look, deg 30, 180 deg from the sun
      {{5.21157e-02, 2.10592e-02, 3.06395e-03}, {3.30335e-03, 3.69793e-03, 4.16261e-03}, {8.4e-05, 6.5e-05, 7.1e-05}},  // eye at 3 km, sun 0 deg high, look, deg 1, 0 deg from the sun
      {{9.91217e-04, 4.70022e-04, 5.42596e-04}, {1.29369e-04, 1.36810e-04, 4.15839e-04}, {3.9e-06, 3.1e-06, 9.5e-06}},  // eye at 3 km, sun -3 deg high, look, deg 10, 90 deg from the sun
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {1.99598e-05, 1.30370e-05, 2.68855e-05}, {1.3e-06, 5.2e-07, 1.0e-06}},  // eye at 3 km, sun -6 deg high, look, deg 0.3, 180 deg from the sun
      {{9.37877e-03, 1.85324e-02, 3.83669e-02}, {2.52604e-03, 6.61668e-03, 2.21497e-02}, {6.7e-05, 1.1e-04, 3.3e-04}},  // eye at 12 km, sun 60 deg high, look, deg 3, 45 deg from the sun
      {{1.38503e-03, 2.94719e-03, 7.15367e-03}, {1.41624e-04, 4.62110e-04, 2.01863e-03}, {3.2e-06, 1.1e-05, 5.4e-05}},  // eye at 12 km, sun 15 deg high, look, deg 45, 20 deg from the sun
      {{5.25190e-04, 8.68682e-04, 2.15377e-03}, {4.48486e-05, 1.11200e-04, 4.69272e-04}, {1.1e-06, 2.4e-06, 1.1e-05}},  // eye at 12 km, sun 2 deg high, look, deg 80, 0 deg from the sun
      {{1.47201e-03, 1.92777e-03, 4.51816e-03}, {7.51867e-05, 1.41752e-04, 5.71738e-04}, {3.2e-06, 4.4e-06, 1.5e-05}},  // eye at 12 km, sun 0 deg high, look, deg 30, 180 deg from the sun
      {{1.10562e-02, 7.18211e-03, 8.28586e-03}, {4.73501e-04, 5.63979e-04, 1.57437e-03}, {3.6e-05, 2.7e-05, 6.6e-05}},  // eye at 12 km, sun -3 deg high, look, deg 1, 0 deg from the sun
      {{3.16983e-05, 1.57646e-05, 3.35990e-05}, {5.04323e-06, 4.77062e-06, 2.29899e-05}, {2.0e-07, 1.5e-07, 6.5e-07}},  // eye at 12 km, sun -6 deg high, look, deg 10, 90 deg from the sun
      {{1.33246e-03, 2.95279e-03, 7.40200e-03}, {2.77109e-04, 7.32475e-04, 3.10280e-03}, {8.5e-06, 1.8e-05, 6.4e-05}},  // eye at 35 km, sun 60 deg high, look, deg 0.3, 180 deg from the sun
      {{7.52050e-04, 1.71845e-03, 4.20999e-03}, {7.26697e-05, 2.20504e-04, 1.04646e-03}, {1.5e-06, 3.4e-06, 2.1e-05}},  // eye at 35 km, sun 15 deg high, look, deg 3, 45 deg from the sun
      {{7.19574e-05, 1.65895e-04, 4.00522e-04}, {3.03433e-06, 7.36906e-06, 3.43912e-05}, {9.8e-08, 1.6e-07, 9.4e-07}},  // eye at 35 km, sun 2 deg high, look, deg 45, 20 deg from the sun
      {{3.57915e-05, 8.12593e-05, 1.95687e-04}, {1.40324e-06, 2.89418e-06, 1.37186e-05}, {5.5e-08, 7.3e-08, 4.5e-07}},  // eye at 35 km, sun 0 deg high, look, deg 80, 0 deg from the sun
      {{1.01009e-04, 1.72159e-04, 4.99757e-04}, {1.29359e-06, 1.79141e-06, 9.34937e-06}, {1.5e-07, 1.2e-07, 5.6e-07}},  // eye at 35 km, sun -3 deg high, look, deg 30, 180 deg from the sun
      {{7.17622e-04, 8.32441e-04, 2.23381e-03}, {7.44182e-06, 8.82726e-06, 4.77822e-05}, {1.2e-06, 8.8e-07, 4.2e-06}},  // eye at 35 km, sun -6 deg high, look, deg 1, 0 deg from the sun
      {{2.14879e-01, 4.44533e-02, 1.74618e-03}, {8.33379e-03, 5.43854e-03, 4.34235e-03}, {3.1e-04, 7.5e-05, 6.1e-05}},  // eye at 0.002 km, sun 1 deg high, look, deg 1, 0 deg from the sun
      {{1.77256e-02, 9.31363e-03, 2.42686e-03}, {2.21415e-03, 2.56004e-03, 3.75632e-03}, {4.5e-05, 3.8e-05, 6.2e-05}},  // eye at 0.002 km, sun 1 deg high, look, deg 5, 180 deg from the sun
      {{1.91808e-03, 1.88125e-03, 2.39782e-03}, {2.94373e-04, 5.47416e-04, 1.55857e-03}, {8.9e-06, 8.9e-06, 3.5e-05}},  // eye at 0.002 km, sun 1 deg high, look, deg 45, 90 deg from the sun
      {{1.71421e-02, 2.75359e-03, 9.93200e-05}, {2.32303e-03, 1.26983e-03, 1.08490e-03}, {4.0e-05, 1.2e-05, 1.2e-05}},  // eye at 0.002 km, sun -2 deg high, look, deg 1, 0 deg from the sun
      {{1.47381e-03, 1.74047e-04, 1.70792e-05}, {4.23327e-04, 3.74856e-04, 7.54198e-04}, {6.0e-06, 4.0e-06, 7.7e-06}},  // eye at 0.002 km, sun -2 deg high, look, deg 5, 180 deg from the sun
      {{6.12089e-04, 3.97714e-04, 5.84872e-04}, {8.59596e-05, 1.09215e-04, 3.50860e-04}, {2.7e-06, 2.5e-06, 9.2e-06}},  // eye at 0.002 km, sun -2 deg high, look, deg 45, 90 deg from the sun
      {{2.53016e-03, 4.62733e-04, 2.33832e-05}, {3.75657e-04, 1.53108e-04, 1.18566e-04}, {8.2e-06, 2.4e-06, 2.1e-06}},  // eye at 0.002 km, sun -5 deg high, look, deg 1, 0 deg from the sun
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {3.43951e-05, 2.75977e-05, 6.45216e-05}, {1.5e-06, 8.4e-07, 1.6e-06}},  // eye at 0.002 km, sun -5 deg high, look, deg 5, 180 deg from the sun
      {{3.63070e-05, 1.98094e-05, 3.71451e-05}, {8.07200e-06, 8.25459e-06, 3.27127e-05}, {2.6e-07, 2.0e-07, 7.0e-07}},  // eye at 0.002 km, sun -5 deg high, look, deg 45, 90 deg from the sun
      {{4.68026e-02, 4.13748e-02, 5.72411e-02}, {1.72018e-02, 1.93859e-02, 3.95445e-02}, {5.1e-04, 3.2e-04, 6.5e-04}},  // eye at 400 km, sun 60 deg high, limb, km 3, 0 deg from the sun
      {{1.41173e-03, 3.24945e-03, 7.63928e-03}, {3.36299e-04, 9.15894e-04, 3.59306e-03}, {9.0e-06, 1.8e-05, 6.8e-05}},  // eye at 400 km, sun 60 deg high, limb, km 40, 90 deg from the sun
      {{6.93139e-04, 7.06474e-04, 1.82988e-03}, {2.24357e-05, 2.08037e-05, 1.07096e-04}, {5.1e-06, 3.5e-06, 1.9e-05}},  // eye at 400 km, sun 10 deg high, limb, km 10, 180 deg from the sun
      {{1.17342e-02, 1.84855e-02, 5.68435e-02}, {1.38318e-03, 2.90710e-03, 1.63395e-02}, {3.3e-05, 4.9e-05, 3.3e-04}},  // eye at 400 km, sun 10 deg high, limb, km 25, 0 deg from the sun
      {{1.10009e-01, 6.02599e-02, 7.72847e-02}, {8.63229e-03, 9.05987e-03, 1.85253e-02}, {3.8e-04, 2.5e-04, 6.0e-04}},  // eye at 400 km, sun -10 deg high, limb, km 3, 0 deg from the sun
      {{1.33608e-03, 4.14586e-04, 8.85496e-04}, {3.60607e-05, 2.70095e-05, 1.79306e-04}, {2.5e-06, 1.6e-06, 1.1e-05}},  // eye at 400 km, sun -5 deg high, limb, km 25, 90 deg from the sun
      {{3.60545e-02, 1.53335e-02, 6.70051e-03}, {2.30344e-03, 1.72798e-03, 2.63169e-03}, {1.5e-04, 5.1e-05, 7.5e-05}},  // eye at 400 km, sun -19 deg high, limb, km 10, 0 deg from the sun
      {{7.10293e-04, 1.63053e-03, 3.83962e-03}, {1.24980e-05, 2.36544e-05, 1.06447e-04}, {7.5e-07, 1.2e-06, 6.1e-06}},  // eye at 400 km, sun -19 deg high, limb, km 50, 20 deg from the sun
      {{2.56578e-03, 1.20474e-03, 5.24885e-03}, {6.28913e-05, 4.23149e-05, 3.37708e-04}, {8.6e-06, 4.5e-06, 3.0e-05}},  // eye at 400 km, sun -24 deg high, limb, km 25, 0 deg from the sun
      {{1.91529e-02, 1.14371e-02, 1.88818e-02}, {2.05290e-03, 1.88785e-03, 5.04409e-03}, {6.5e-05, 5.1e-05, 1.4e-04}},  // eye at 400 km, sun 0 deg high, limb, km 10, 90 deg from the sun
      {{5.19323e-02, 4.23641e-02, 6.23492e-02}, {7.12042e-03, 9.51247e-03, 2.33306e-02}, {1.9e-04, 2.0e-04, 5.2e-04}},  // eye at 20000 km, sun 40 deg high, limb, km 5, 90 deg from the sun
      {{5.95523e-03, 1.11125e-02, 3.10289e-02}, {9.91316e-04, 2.29169e-03, 1.10802e-02}, {3.7e-05, 6.5e-05, 2.6e-04}},  // eye at 20000 km, sun -30 deg high, limb, km 30, 0 deg from the sun
      {{5.65809e-02, 5.80087e-02, 9.60637e-02}, {6.08341e-03, 9.62990e-03, 2.69858e-02}, {1.1e-04, 1.6e-04, 5.8e-04}},  // eye at 20000 km, sun -60 deg high, limb, km 10, 0 deg from the sun
      {{4.98166e-02, 2.50595e-02, 1.42502e-02}, {2.82817e-03, 3.82303e-03, 7.36852e-03}, {1.5e-04, 7.9e-05, 1.3e-04}},  // eye at 12 km, sun 2 deg high, ground, km 100, 0 deg from the sun
      {{3.75061e-03, 7.48419e-03, 1.57225e-02}, {9.05486e-04, 2.56524e-03, 9.55123e-03}, {1.6e-05, 3.4e-05, 1.6e-04}},  // eye at 400 km, sun 30 deg high, ground, km 300, 90 deg from the sun
      {{9.12760e-03, 7.51831e-03, 1.48303e-02}, {7.60726e-04, 8.81011e-04, 2.74043e-03}, {2.8e-05, 2.4e-05, 8.7e-05}},  // eye at 400 km, sun 12 deg high, ground, km 1500, 180 deg from the sun
      {{5.21512e-03, 6.01377e-03, 9.80114e-03}, {5.53738e-04, 1.06551e-03, 3.24066e-03}, {2.2e-05, 2.1e-05, 7.6e-05}},  // eye at 2000 km, sun 20 deg high, ground, km 2000, 180 deg from the sun
  };
}
// clang-format on

}  // namespace app::accuracy
