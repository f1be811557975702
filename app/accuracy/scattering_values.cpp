// Written by globe_scattering_reference (tests/bench/air/scattering_reference.cpp).

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
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {2.35788e-04, 1.70881e-04, 3.20356e-04}, {2.4e-06, 1.3e-06, 2.4e-06}},  // eye at 0.002 km, sun -3 deg high, look, deg 0.3, 180 deg from the sun
      {{4.87041e-04, 1.36864e-04, 4.21669e-05}, {6.66003e-05, 3.58040e-05, 4.58012e-05}, {2.0e-06, 7.7e-07, 8.8e-07}},  // eye at 0.002 km, sun -6 deg high, look, deg 3, 45 deg from the sun
      {{5.17957e-03, 1.07764e-02, 2.32362e-02}, {8.38692e-04, 2.48186e-03, 9.09062e-03}, {1.9e-05, 3.9e-05, 1.3e-04}},  // eye at 3 km, sun 60 deg high, look, deg 45, 20 deg from the sun
      {{2.04596e-03, 4.04461e-03, 8.44060e-03}, {3.13093e-04, 1.01304e-03, 4.07393e-03}, {5.4e-06, 1.3e-05, 6.3e-05}},  // eye at 3 km, sun 15 deg high, look, deg 80, 0 deg from the sun
      {{4.15555e-03, 5.15472e-03, 7.72110e-03}, {3.63636e-04, 7.94208e-04, 2.47654e-03}, {1.0e-05, 1.4e-05, 4.7e-05}},  // eye at 3 km, sun 2 deg high, look, deg 30, 180 deg from the sun
      {{5.21157e-02, 2.10592e-02, 3.06395e-03}, {3.30335e-03, 3.69793e-03, 4.16261e-03}, {8.4e-05, 6.5e-05, 7.1e-05}},  // eye at 3 km, sun 0 deg high, look, deg 1, 0 deg from the sun
      {{9.91217e-04, 4.70022e-04, 5.42596e-04}, {1.29369e-04, 1.36810e-04, 4.15839e-04}, {3.9e-06, 3.1e-06, 9.5e-06}},  // eye at 3 km, sun -3 deg high, look, deg 10, 90 deg from the sun
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {2.02127e-05, 1.32918e-05, 2.72051e-05}, {5.0e-07, 2.1e-07, 4.1e-07}},  // eye at 3 km, sun -6 deg high, look, deg 0.3, 180 deg from the sun
      {{9.37877e-03, 1.85324e-02, 3.83669e-02}, {2.52604e-03, 6.61668e-03, 2.21497e-02}, {6.7e-05, 1.1e-04, 3.3e-04}},  // eye at 12 km, sun 60 deg high, look, deg 3, 45 deg from the sun
      {{1.38503e-03, 2.94719e-03, 7.15367e-03}, {1.41624e-04, 4.62110e-04, 2.01863e-03}, {3.2e-06, 1.1e-05, 5.4e-05}},  // eye at 12 km, sun 15 deg high, look, deg 45, 20 deg from the sun
      {{5.25190e-04, 8.68682e-04, 2.15377e-03}, {4.48486e-05, 1.11200e-04, 4.69272e-04}, {1.1e-06, 2.4e-06, 1.1e-05}},  // eye at 12 km, sun 2 deg high, look, deg 80, 0 deg from the sun
      {{1.47201e-03, 1.92777e-03, 4.51816e-03}, {7.51867e-05, 1.41752e-04, 5.71738e-04}, {3.2e-06, 4.4e-06, 1.5e-05}},  // eye at 12 km, sun 0 deg high, look, deg 30, 180 deg from the sun
      {{1.10562e-02, 7.18211e-03, 8.28586e-03}, {4.73501e-04, 5.63979e-04, 1.57437e-03}, {3.6e-05, 2.7e-05, 6.6e-05}},  // eye at 12 km, sun -3 deg high, look, deg 1, 0 deg from the sun
      {{3.16983e-05, 1.57646e-05, 3.35990e-05}, {4.96580e-06, 4.74485e-06, 2.29906e-05}, {1.8e-07, 1.3e-07, 5.7e-07}},  // eye at 12 km, sun -6 deg high, look, deg 10, 90 deg from the sun
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
      {{2.53016e-03, 4.62733e-04, 2.33832e-05}, {3.74467e-04, 1.52259e-04, 1.17830e-04}, {6.0e-06, 1.7e-06, 1.4e-06}},  // eye at 0.002 km, sun -5 deg high, look, deg 1, 0 deg from the sun
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {3.53022e-05, 2.78279e-05, 6.37547e-05}, {5.9e-07, 3.2e-07, 5.7e-07}},  // eye at 0.002 km, sun -5 deg high, look, deg 5, 180 deg from the sun
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

std::vector<ScatteredLight> drawn_scattering_values() {
  return {
      {{3.46974e-02, 4.54183e-02, 3.94625e-02}, {6.80698e-03, 1.43646e-02, 2.63397e-02}, {1.5e-04, 2.3e-04, 6.3e-04}},  // drawn look 0: eye at 0.158 km, look 3.13 deg, sun 16.2 deg high there
      {{6.06437e-04, 1.40147e-03, 3.32720e-03}, {1.42638e-05, 2.80286e-05, 1.30356e-04}, {5.7e-07, 1.0e-06, 5.3e-06}},  // drawn look 1: eye at 311 km, look -16.1 deg, sun -1.02 deg high there
      {{4.29417e-06, 2.39274e-06, 4.75504e-06}, {1.74869e-06, 1.70586e-06, 6.94836e-06}, {4.2e-08, 3.1e-08, 1.2e-07}},  // drawn look 2: eye at 0.156 km, look 80.8 deg, sun -6.3 deg high there
      {{2.80146e-02, 3.54209e-02, 5.48992e-02}, {9.12882e-03, 1.50961e-02, 3.66715e-02}, {1.9e-04, 2.5e-04, 5.1e-04}},  // drawn look 3: eye at 7.63e+03 km, look -63 deg, sun 41.6 deg high there
      {{1.03985e-03, 1.22966e-03, 4.45174e-03}, {2.39382e-05, 3.37269e-05, 1.94667e-04}, {2.4e-06, 1.9e-06, 9.6e-06}},  // drawn look 4: eye at 26.5 km, look 4.59 deg, sun -2.1 deg high there
      {{9.04354e-04, 1.39565e-03, 3.60948e-03}, {9.20578e-06, 1.47743e-05, 7.33969e-05}, {8.7e-07, 1.1e-06, 5.0e-06}},  // drawn look 5: eye at 746 km, look -25.7 deg, sun -4.41 deg high there
      {{4.26552e-03, 8.63161e-03, 1.78804e-02}, {7.07148e-04, 2.13123e-03, 7.85827e-03}, {1.2e-05, 2.8e-05, 1.1e-04}},  // drawn look 6: eye at 0.528 km, look 79.9 deg, sun 41.5 deg high there
      {{2.72612e-02, 2.25874e-02, 3.44280e-02}, {4.86069e-03, 6.01460e-03, 1.35316e-02}, {1.4e-04, 1.4e-04, 3.3e-04}},  // drawn look 7: eye at 3.18e+04 km, look -80.4 deg, sun 5.06 deg high there
      {{1.33663e-02, 1.33832e-02, 9.61548e-03}, {2.03735e-03, 3.96180e-03, 8.01527e-03}, {5.9e-05, 8.5e-05, 1.5e-04}},  // drawn look 8: eye at 3.35 km, look 3.66 deg, sun 2.49 deg high there
      {{2.52937e-02, 2.97519e-02, 5.55751e-02}, {7.92214e-03, 1.21892e-02, 3.59005e-02}, {1.8e-04, 2.0e-04, 6.0e-04}},  // drawn look 9: eye at 7.8e+03 km, look -63.2 deg, sun 59.8 deg high there
      {{1.53556e-04, 3.47818e-04, 8.54902e-04}, {9.55951e-06, 2.59799e-05, 1.20844e-04}, {1.9e-07, 4.3e-07, 3.2e-06}},  // drawn look 10: eye at 29.9 km, look 35.6 deg, sun 4.2 deg high there
      {{2.30752e-03, 1.24809e-03, 2.26331e-03}, {3.31803e-04, 2.97798e-04, 8.81046e-04}, {1.4e-05, 9.7e-06, 3.1e-05}},  // drawn look 11: eye at 466 km, look -22.5 deg, sun -2.18 deg high there
      {{2.06680e-02, 3.36941e-02, 4.17706e-02}, {7.89813e-03, 1.78221e-02, 3.81885e-02}, {1.7e-04, 2.9e-04, 5.5e-04}},  // drawn look 12: eye at 0.00493 km, look 4.98 deg, sun 50.2 deg high there
      {{1.49046e-02, 4.95578e-03, 2.72113e-03}, {7.46766e-04, 5.13130e-04, 1.25437e-03}, {3.5e-05, 1.6e-05, 3.9e-05}},  // drawn look 13: eye at 4.02e+03 km, look -52.1 deg, sun -1.67 deg high there
      {{3.76509e-03, 4.82151e-03, 6.21182e-03}, {6.70741e-04, 1.56770e-03, 4.50693e-03}, {1.7e-05, 3.1e-05, 9.3e-05}},  // drawn look 14: eye at 0.0955 km, look 27.9 deg, sun 3.67 deg high there
      {{9.81583e-03, 1.77394e-02, 3.45024e-02}, {3.19779e-03, 7.83604e-03, 2.52416e-02}, {8.2e-05, 1.3e-04, 4.3e-04}},  // drawn look 15: eye at 4.69e+03 km, look -56.1 deg, sun 43.6 deg high there
      {{2.33810e-02, 2.04481e-02, 9.79464e-03}, {3.32344e-03, 5.32928e-03, 8.53226e-03}, {7.9e-05, 9.3e-05, 1.8e-04}},  // drawn look 16: eye at 0.0067 km, look 4.97 deg, sun 3.58 deg high there
      {{1.44816e-02, 4.85922e-03, 2.26925e-03}, {8.21983e-04, 5.45517e-04, 1.29721e-03}, {3.8e-05, 1.7e-05, 3.5e-05}},  // drawn look 17: eye at 158 km, look -12.1 deg, sun -1.63 deg high there
      {{3.07225e-03, 6.33220e-03, 1.37597e-02}, {4.00925e-04, 1.29839e-03, 5.15822e-03}, {8.2e-06, 2.0e-05, 7.5e-05}},  // drawn look 18: eye at 4.1 km, look 55.3 deg, sun 21 deg high there
      {{2.37941e-02, 2.04352e-02, 2.99080e-02}, {2.02623e-03, 3.21484e-03, 8.60680e-03}, {1.3e-04, 7.7e-05, 1.7e-04}},  // drawn look 19: eye at 1.31e+03 km, look -35.3 deg, sun 3.68 deg high there
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {2.81811e-05, 1.94909e-05, 3.86754e-05}, {5.6e-07, 2.5e-07, 4.2e-07}},  // drawn look 20: eye at 0.00251 km, look 2.35 deg, sun -5.46 deg high there
      {{4.51492e-02, 3.93270e-02, 5.48540e-02}, {1.26899e-02, 1.57313e-02, 3.50187e-02}, {3.2e-04, 3.1e-04, 8.3e-04}},  // drawn look 21: eye at 2.08e+03 km, look -41 deg, sun 34.8 deg high there
      {{3.10884e-04, 8.03580e-05, 5.54989e-05}, {1.00112e-04, 9.10614e-05, 2.36526e-04}, {1.9e-06, 1.3e-06, 2.9e-06}},  // drawn look 22: eye at 0.0719 km, look 7.88 deg, sun -3.63 deg high there
      {{1.79014e-05, 5.26573e-06, 6.15234e-06}, {3.00684e-05, 2.27628e-05, 7.84769e-05}, {4.8e-07, 2.6e-07, 8.2e-07}},  // drawn look 23: eye at 1.44e+03 km, look -36.8 deg, sun -4.92 deg high there
      {{3.60430e-02, 5.37858e-02, 5.91439e-02}, {8.69015e-03, 1.93224e-02, 3.93348e-02}, {1.9e-04, 3.8e-04, 7.2e-04}},  // drawn look 24: eye at 1.57 km, look 2.34 deg, sun 40.1 deg high there
      {{1.87763e-04, 2.89732e-04, 7.45005e-04}, {1.31860e-06, 1.75215e-06, 8.32793e-06}, {2.4e-07, 2.0e-07, 8.9e-07}},  // drawn look 25: eye at 3.49e+03 km, look -49.4 deg, sun -6.56 deg high there
      {{6.26705e-05, 3.62449e-05, 7.15287e-05}, {7.87853e-06, 8.99259e-06, 3.94288e-05}, {3.1e-07, 3.0e-07, 1.1e-06}},  // drawn look 26: eye at 1.38 km, look 86.9 deg, sun -4.29 deg high there
      {{1.41631e-02, 2.11393e-02, 3.71727e-02}, {1.66433e-03, 3.99697e-03, 1.29004e-02}, {5.3e-05, 8.8e-05, 4.0e-04}},  // drawn look 27: eye at 1.98e+03 km, look -42.5 deg, sun 8.02 deg high there
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {2.41507e-04, 2.00917e-04, 4.20516e-04}, {2.4e-06, 1.4e-06, 2.7e-06}},  // drawn look 28: eye at 2.29 km, look 0.642 deg, sun -2.89 deg high there
      {{6.30587e-04, 1.56607e-04, 5.63805e-04}, {3.43004e-05, 1.92551e-05, 1.34420e-04}, {2.6e-06, 1.0e-06, 6.9e-06}},  // drawn look 29: eye at 1.37e+04 km, look -71.4 deg, sun -5.29 deg high there
      {{1.95235e-02, 3.50744e-02, 5.81794e-02}, {2.98334e-03, 8.49161e-03, 2.60747e-02}, {4.4e-05, 1.3e-04, 4.1e-04}},  // drawn look 30: eye at 1.4 km, look 11.8 deg, sun 36.9 deg high there
      {{1.66135e-04, 1.33467e-04, 3.30540e-04}, {1.99913e-05, 1.44473e-05, 5.91123e-05}, {1.7e-06, 9.6e-07, 3.9e-06}},  // drawn look 31: eye at 159 km, look -13.1 deg, sun -7.25 deg high there
      {{1.32716e-03, 5.54698e-04, 3.79645e-04}, {1.69814e-04, 1.40665e-04, 2.94503e-04}, {6.4e-06, 3.8e-06, 6.7e-06}},  // drawn look 32: eye at 0.71 km, look 5.77 deg, sun -3.9 deg high there
      {{5.26156e-03, 9.06481e-03, 2.66758e-02}, {1.59117e-03, 3.21583e-03, 1.51062e-02}, {5.1e-05, 7.8e-05, 3.3e-04}},  // drawn look 33: eye at 587 km, look -23.1 deg, sun 89.7 deg high there
      {{3.20073e-03, 5.25742e-03, 8.64951e-03}, {5.02723e-04, 1.42824e-03, 4.87478e-03}, {1.2e-05, 2.3e-05, 9.0e-05}},  // drawn look 34: eye at 0.0403 km, look 53.3 deg, sun 7.95 deg high there
      {{6.53197e-03, 7.11850e-03, 1.15896e-02}, {1.07798e-03, 1.98959e-03, 5.71009e-03}, {4.1e-05, 4.5e-05, 1.3e-04}},  // drawn look 35: eye at 281 km, look -21.8 deg, sun 2.45 deg high there
      {{3.28037e-02, 4.39353e-02, 4.40133e-02}, {1.56092e-02, 2.70982e-02, 4.34128e-02}, {4.8e-04, 5.5e-04, 6.4e-04}},  // drawn look 36: eye at 0.0203 km, look 1.48 deg, sun 82.9 deg high there
      {{6.34393e-03, 7.03640e-03, 2.74038e-02}, {2.56566e-04, 3.30611e-04, 2.17334e-03}, {8.9e-06, 8.7e-06, 5.9e-05}},  // drawn look 37: eye at 6.01e+03 km, look -58.9 deg, sun -0.54 deg high there
      {{2.35851e-04, 1.33617e-04, 2.19609e-04}, {3.55532e-05, 3.97286e-05, 1.45685e-04}, {1.1e-06, 1.0e-06, 3.6e-06}},  // drawn look 38: eye at 0.00216 km, look 39.8 deg, sun -3.35 deg high there
      {{3.39744e-02, 3.86625e-02, 5.68379e-02}, {1.15563e-02, 1.67272e-02, 3.81945e-02}, {3.4e-04, 3.1e-04, 7.3e-04}},  // drawn look 39: eye at 159 km, look -12.8 deg, sun 49.7 deg high there
      {{2.17416e-02, 2.40964e-02, 1.68028e-02}, {3.47249e-03, 6.79577e-03, 1.25763e-02}, {1.3e-04, 1.5e-04, 2.6e-04}},  // drawn look 40: eye at 0.045 km, look 5.64 deg, sun 5.74 deg high there
      {{2.22375e-03, 5.02918e-03, 1.17986e-02}, {1.27619e-04, 3.28286e-04, 1.49119e-03}, {4.7e-06, 8.3e-06, 4.1e-05}},  // drawn look 41: eye at 2.33e+04 km, look -77.5 deg, sun 3.76 deg high there
      {{5.64535e-03, 1.08713e-02, 1.99561e-02}, {1.25545e-03, 3.83228e-03, 1.33877e-02}, {2.6e-05, 7.3e-05, 2.7e-04}},  // drawn look 42: eye at 0.122 km, look 29.2 deg, sun 24.3 deg high there
      {{5.59122e-05, 1.36934e-05, 1.12589e-05}, {6.38624e-05, 4.66793e-05, 1.48881e-04}, {1.1e-06, 5.4e-07, 1.6e-06}},  // drawn look 43: eye at 6.27e+03 km, look -60.2 deg, sun -4.15 deg high there
      {{0.00000e+00, 0.00000e+00, 0.00000e+00}, {9.45190e-06, 6.69277e-06, 1.45130e-05}, {2.8e-07, 1.4e-07, 2.3e-07}},  // drawn look 44: eye at 0.732 km, look 5.31 deg, sun -6.66 deg high there
      {{3.81923e-02, 3.85599e-02, 5.74749e-02}, {1.31530e-02, 1.73359e-02, 3.89557e-02}, {3.9e-04, 3.2e-04, 8.1e-04}},  // drawn look 45: eye at 1.09e+04 km, look -68.4 deg, sun 78.7 deg high there
      {{1.53461e-02, 1.77233e-02, 1.85841e-02}, {1.64901e-03, 3.53884e-03, 8.75763e-03}, {5.1e-05, 7.9e-05, 2.0e-04}},  // drawn look 46: eye at 0.387 km, look 13.4 deg, sun 4.4 deg high there
      {{2.05133e-04, 1.83055e-04, 4.62409e-04}, {1.40761e-05, 1.13168e-05, 4.92235e-05}, {1.9e-06, 1.1e-06, 5.1e-06}},  // drawn look 47: eye at 2.1e+03 km, look -41.9 deg, sun -7.24 deg high there
      {{3.74293e-02, 4.29249e-02, 2.98838e-02}, {6.35904e-03, 1.22662e-02, 2.05001e-02}, {2.6e-04, 3.5e-04, 4.8e-04}},  // drawn look 48: eye at 0.102 km, look 2.8 deg, sun 10.7 deg high there
      {{2.62158e-03, 5.90791e-03, 1.39782e-02}, {1.66677e-04, 4.68827e-04, 2.15266e-03}, {3.5e-06, 1.0e-05, 6.2e-05}},  // drawn look 49: eye at 4.96e+03 km, look -55.6 deg, sun 6.94 deg high there
  };
}
// clang-format on

}  // namespace app::accuracy
