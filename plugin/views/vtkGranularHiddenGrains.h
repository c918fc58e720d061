// SPDX-License-Identifier: BSD-3-Clause
#ifndef vtkGranularHiddenGrains_h
#define vtkGranularHiddenGrains_h

#include "vtkType.h"

#include <array>
#include <vector>

/**
 * Tells which particles of a dense packing need not be drawn, because others hide them or because they are not in the picture.
 *
 * The picture is divided into cells of about half a particle. A cell that the inner part of a particle covers hides what is farther away
 * than the centre of this particle. A particle is hidden if all cells around it are. This errs on the safe side: no pixel
 * changes.
 */
class vtkGranularHiddenGrains
{
public:
  /// The way from the points to the picture: x y z of the camera, which looks along -z, are ToCamera times x y z 1.
  struct View
  {
    float ToCamera[3][4];
    bool Parallel = false;
    float Scale
      [2]; ///< the picture, from -1 to 1, is Scale x + Middle of a place at z = -1, or of any place if Parallel
    float Middle[2];
    float Near = 0.0F;   ///< z is smaller, unless it is cut away
    float Radius = 1.0F; ///< factor on all radii
  };

  /// Particles: x y z of each, the radius of a sphere around it, and that of a sphere inside it.
  struct Grains
  {
    const float* Points = nullptr;
    const float* Outer = nullptr;
    const float* Inner = nullptr;
    vtkIdType Count = 0;
  };

  /// The particles that may be seen, in their order, and which part of the square around each: low and high x and y, from 0 to 255.
  struct Seen
  {
    std::vector<vtkIdType> Grains;
    std::vector<std::array<unsigned char, 4>> Parts;
  };

  /// Returns the particles that may be seen.
  const Seen& Find(const View& view, const Grains& grains);

private:
  struct Square;
  void MakeCells(const View& view, const Grains& grains);
  void CoverBy(const View& view, const Grains& grains, vtkIdType begin, vtkIdType end,
    std::vector<float>& depths) const;
  void Cover(const Square& square, std::vector<float>& depths) const;
  void MakeBlocks();
  Seen FindSeen(const View& view, const Grains& grains, vtkIdType begin, vtkIdType end) const;
  bool FindPart(const Square& square, std::array<unsigned char, 4>& part) const;
  int CellOf(float at) const;

  int Side = 0;              ///< cells along each axis
  std::vector<float> Depths; ///< of each cell; what is farther away is hidden
  int BlockSides = 0;
  std::vector<float> Blocks; ///< of each block of cells, the largest of their depths
  Seen Found;
};

#endif
