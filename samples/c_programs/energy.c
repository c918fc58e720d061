/* SPDX-License-Identifier: BSD-3-Clause */
/* The kinetic energy of each frame of a run: energy FILES... */
#include <granular.h>

#include <stdio.h>

static int fail(void)
{
  fprintf(stderr, "%s\n", granular_last_error()->message);
  return 1;
}

int main(int argc, char** argv)
{
  granular_run* run = NULL;
  granular_run_facts facts;
  if (granular_open((const char* const*)argv + 1, (size_t)(argc - 1), NULL, &run) ||
    granular_run_info(run, &facts))
  {
    return fail();
  }
  /* only these columns are read */
  const char* const wanted[] = { "v", "mass" };
  granular_request request;
  granular_request_init(&request);
  request.arrays = wanted;
  request.array_count = 2;
  for (int64_t i = 0; i < facts.frames; ++i)
  {
    granular_frame* frame = NULL;
    granular_frame_header header;
    granular_array v;
    granular_array mass;
    if (granular_read(run, i, &request, &frame) || granular_header(frame, &header) ||
      granular_array_named(frame, "v", &v) || granular_array_named(frame, "mass", &mass))
    {
      return fail();
    }
    double energy = 0;
    for (int64_t row = 0; row < header.rows; ++row)
    {
      const double* u = (const double*)v.data + 3 * row;
      energy += 0.5 * ((const double*)mass.data)[row] * (u[0] * u[0] + u[1] * u[1] + u[2] * u[2]);
    }
    printf("%lld %lld %.12g\n", (long long)header.timestep, (long long)header.rows, energy);
    granular_release(frame);
  }
  granular_close(run);
  return 0;
}
