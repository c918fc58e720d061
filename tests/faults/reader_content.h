// SPDX-License-Identifier: BSD-3-Clause
// All that a reader shows and says, to be compared.
#ifndef granular_tests_faults_reader_content_h
#define granular_tests_faults_reader_content_h

#include "vtkAbstractArray.h"
#include "vtkAlgorithm.h"
#include "vtkDataObject.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

/// Times, and every value of every array of all outputs.
inline std::string Content(vtkAlgorithm* reader)
{
  std::ostringstream text;
  text.precision(17);
  for (int port = 0; port < reader->GetNumberOfOutputPorts(); ++port)
  {
    vtkInformation* info = reader->GetOutputInformation(port);
    using Pipeline = vtkStreamingDemandDrivenPipeline;
    for (int i = 0; i < info->Length(Pipeline::TIME_STEPS()); ++i)
    {
      text << info->Get(Pipeline::TIME_STEPS())[i] << " ";
    }
    vtkDataObject* output = reader->GetOutputDataObject(port);
    for (int type = 0; type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
    {
      text << "\n" << output->GetNumberOfElements(type);
      vtkFieldData* arrays = output->GetAttributesAsFieldData(type);
      for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
      {
        vtkAbstractArray* array = arrays->GetAbstractArray(i);
        text << "\n" << array->GetName();
        for (vtkIdType value = 0; value < array->GetNumberOfValues(); ++value)
        {
          text << " " << array->GetVariantValue(value).ToString();
        }
      }
    }
  }
  return text.str();
}

/// Whether no output holds anything.
inline bool IsEmpty(vtkAlgorithm* reader)
{
  for (int port = 0; port < reader->GetNumberOfOutputPorts(); ++port)
  {
    vtkDataObject* output = reader->GetOutputDataObject(port);
    for (int type = 0; output && type < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++type)
    {
      if (output->GetNumberOfElements(type) > 0)
      {
        return false;
      }
    }
  }
  return true;
}

/// What was said, without the address of who said it.
inline std::string Words(const std::vector<std::string>& said)
{
  const std::string of = "): ";
  std::string words;
  for (const std::string& text : said)
  {
    words += text.substr(std::min(text.find(of), text.size())) + "\n";
  }
  return words;
}
#endif
