// SPDX-License-Identifier: BSD-3-Clause
// A simulation in C++11 that writes its particles: falling FILE
#include <granular.h>

#include <cstdio>
#include <vector>

namespace
{
bool failed(granular_status status)
{
  if (status != GRANULAR_OK)
  {
    std::fprintf(stderr, "%s\n", granular_last_error()->message);
  }
  return status != GRANULAR_OK;
}

granular_array reals(const char* name, const std::vector<double>& values, int components)
{
  granular_array array = {};
  array.name = name;
  array.type = GRANULAR_FLOAT64;
  array.components = components;
  array.data = values.data();
  return array;
}
}

int main(int argc, char** argv)
{
  const int particles = 10;
  std::vector<double> x, v(3 * particles), radius(particles, 0.25);
  for (int i = 0; i < particles; ++i)
  {
    x.insert(x.end(), { 0.5 + i % 5, 0.5 + i / 5, 8.0 });
  }
  granular_format format;
  granular_format_init(&format);
  format.dialect = "LIGGGHTS";
  granular_writer* writer = nullptr;
  if (failed(granular_create(argc > 1 ? argv[1] : "falling.dump", &format, &writer)))
  {
    return 1;
  }
  granular_box box = {};
  box.vectors[0] = box.vectors[4] = 5;
  box.vectors[8] = 10;
  box.boundary = "pp pp ff";
  for (int step = 0; step <= 300; ++step)
  {
    if (step % 100 == 0)
    {
      const granular_array arrays[] = { reals("points", x, 3), reals("v", v, 3),
        reals("radius", radius, 1) };
      granular_content frame;
      granular_content_init(&frame);
      frame.timestep = step;
      frame.box = &box;
      frame.rows = particles;
      frame.arrays = arrays;
      frame.array_count = 3;
      if (failed(granular_write(writer, &frame)))
      {
        granular_abandon(writer); // the old file is as it was
        return 1;
      }
    }
    for (int i = 0; i < particles; ++i)
    {
      v[3 * i + 2] -= 9.81 * 1e-3;
      x[3 * i + 2] += v[3 * i + 2] * 1e-3;
    }
  }
  return failed(granular_finish(writer)) ? 1 : 0;
}
