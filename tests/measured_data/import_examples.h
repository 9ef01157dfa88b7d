// SPDX-License-Identifier: LGPL-2.1-or-later

// Files as instruments, spreadsheets and people write them, and what of a map
// is proposed for them.

#ifndef slipstep_tests_measured_data_import_examples_h
#define slipstep_tests_measured_data_import_examples_h

#include <string>
#include <vector>

namespace SlipStep::Testing
{
  struct Example
  {
    std::string name;
    std::string text;
    /// "Columns/Time = t in s"; what is open has "? " before it.
    std::vector<std::string> expected;
    std::vector<std::string> absent; ///< paths
  };

  inline const std::vector<Example> import_examples = {
    // No wind blows in "Geschwindigkeit", and no fan in "Umfang".
    {"speed_in_german.csv",
     "Zeit [ms];Geschwindigkeit [m/min];Reibwert [-];Druck [N/mm2]\n"
     "0;0,030;0,0001;3,006\n50;0,030;0,2086;3,005\n100;0,031;0,2096;3,0\n",
     {"Columns/Speed = Geschwindigkeit [m/min] in m/min"},
     {"Constants/Speed"}},
    {"speed_of_a_circumference.csv",
     "Zeit in s\tUmfangsgeschwindigkeit in mm/s\tReibwert\r\n"
     "0\t0,5\t0,0001\r\n1\t0,5\t0,2086\r\n2\t0,6\t0,2096\r\n",
     {"Columns/Speed = Umfangsgeschwindigkeit in mm/s in mm/s"},
     {"Constants/Speed"}},
    {"speed_of_wind.csv",
     "time (s),wind speed (m/s),disp (mm),mu\n"
     "0,0.1,0,0.001\n1,0.2,1,0.256\n2,0.1,2,0.268\n",
     {"Columns/Displacement = disp (mm) in mm"},
     {"Columns/Speed"}},
    // What is called normal is, before what is only a load or a stress.
    {"biaxial.txt",
     "  row     lp_disp   shr_stress  nor_disp  nor_stress   time   mu\n"
     "  rec    micron   MPa   micron   MPa  sec  .\n"
     "  1  0  0.0064  3.2  5.007  0    0.0013\n"
     "  2  5  1.2800  3.3  5.002  0.1  0.2562\n"
     "  3  9  1.4350  3.1  4.998  0.2  0.2875\n",
     {"Columns/Displacement = lp_disp in micron",
      "Columns/Pressure = nor_stress in MPa",
      "Columns/Friction = mu"},
     {"Columns/Normal load"}},
    {"lbf.csv",
     "Time (sec),Crosshead (in),Load (lbf),Normal (lbf),COF\n"
     "0,0,0.1,112.5,0.001\n0.1,0.0039,28.7,112.3,0.256\n"
     "0.2,0.0078,30.1,112.4,0.268\n",
     {"Columns/Normal load = Normal (lbf) in lbf", "Columns/Friction = COF"},
     {}},
    {"two_loads.csv",
     "Time (s),Position (mm),Load (N),Normal (N)\n"
     "0,0,0.01,4.99\n0.1,0.1,0.25,4.98\n0.2,0.2,1.4,5.01\n",
     {"Columns/Normal load = Normal (N) in N",
      "? Columns/Tangential load = Load (N) in N"},
     {"Columns/Friction"}},
    {"two_stresses.csv",
     "time (s),LP disp (mm),Stress (MPa),Normal (MPa)\n"
     "0,0,0.01,4.99\n0.1,0.1,0.25,4.98\n0.2,0.2,1.4,5.01\n",
     {"Columns/Pressure = Normal (MPa) in MPa",
      "? Columns/Friction = {Stress (MPa) in MPa}/{Normal (MPa) in MPa}"},
     {}},
    {"shear_stress_short.csv",
     "time (s),disp (mm),shr_stress (MPa),nor_stress (MPa)\n"
     "0,0,0.01,4.99\n0.1,0.1,0.25,4.98\n0.2,0.2,1.4,5.01\n",
     {"Columns/Pressure = nor_stress (MPa) in MPa",
      "Columns/Friction = {shr_stress (MPa) in MPa}/{nor_stress (MPa) in MPa}"},
     {}},
    // Neither is called so: either may be what is pulled.
    {"axial.csv",
     "time (s),disp (mm),axial load (N),confining pressure (MPa)\n"
     "0,0,0.01,4.99\n0.1,0.1,0.25,4.98\n0.2,0.2,1.4,5.01\n",
     {"? Columns/Normal load = axial load (N) in N"},
     {"Columns/Pressure"}},
    {"quoted_commas.csv",
     "\"Zeit (s)\",\"Weg (mm)\",\"Reibkraft (N)\",\"Normalkraft (N)\"\n"
     "\"0,0000\",\"0,0000\",\"0,6441\",\"500,7247\"\n"
     "\"0,1000\",\"0,1000\",\"128,0461\",\"499,6177\"\n"
     "\"0,2000\",\"0,2000\",\"141,5241\",\"500,1120\"\n",
     {"Raw file/Delimiter = comma",
      "Raw file/Decimal mark = comma",
      "Columns/Tangential load = Reibkraft (N) in N"},
     {}},
    {"labview.lvm",
     "LabVIEW Measurement\t\nWriter_Version\t2\nSeparator\tTab\n"
     "Date\t2023/01/01\nTime\t10:00:00.1\n***End_of_Header***\t\n\t\n"
     "Channels\t3\t\t\t\nSamples\t30\t30\t30\t\n"
     "Date\t2023/01/01\t2023/01/01\t2023/01/01\t\n"
     "X0\t0.0E+0\t0.0E+0\t0.0E+0\t\nDelta_X\t0.1\t0.1\t0.1\t\n"
     "***End_of_Header***\t\t\t\t\n"
     "X_Value\tNormal force\tFriction force\tPosition\tComment\n" +
       []() {
         std::string rows;
         for (int i = 0; i < 30; ++i)
           rows += std::to_string(0.1 * i) + "\t100.1\t" +
                   std::to_string(0.5 * i) + "\t" + std::to_string(0.01 * i) +
                   "\n";
         return rows;
       }(),
     {"Raw file/Header line = 14",
      "? Columns/Normal load = Normal force in N",
      "? Columns/Tangential load = Friction force in N"},
     {}},
    // Comments that some rows have and some end before.
    {"comment_first.lvm",
     "LabVIEW Measurement\n"
     "***End_of_Header***\t\n\n"
     "Y_Unit_Label\tmm\tN\tN\n"
     "***End_of_Header***\n"
     "X_Value\tPosition\tFriction Force\tNormal Force\tComment\n"
     "0.00\t0.000\t0.0028\t30.062\tstart\n"
     "0.05\t0.025\t6.2683\t30.049\n"
     "0.10\t0.050\t6.2848\t29.986\n"
     "0.15\t0.075\t6.3459\t30.007\n",
     {"Raw file/Header line = 6",
      "? Columns/Displacement = Position in mm",
      "? Columns/Tangential load = Friction Force in N",
      "? Columns/Normal load = Normal Force in N"},
     {"Raw file/Has header"}},
    {"comment_most.lvm",
     "LabVIEW Measurement\r\n"
     "***End_of_Header***\t\r\n\r\n"
     "Y_Unit_Label\tmm\tN\tN\r\n"
     "***End_of_Header***\r\n"
     "X_Value\tPosition\tFriction Force\tNormal Force\tComment\r\n"
     "0.00\t0.000\t0.0028\t30.062\r\n"
     "0.05\t0.025\t6.2683\t30.049\tfast\r\n"
     "0.10\t0.050\t6.2848\t29.986\r\n"
     "0.15\t0.075\t6.3459\t30.007\tend\r\n",
     {"Raw file/Header line = 6",
      "? Columns/Displacement = Position in mm",
      "? Columns/Tangential load = Friction Force in N",
      "? Columns/Normal load = Normal Force in N"},
     {"Raw file/Has header"}},
    {"comment_three.lvm",
     "LabVIEW Measurement\n"
     "***End_of_Header***\t\n\n"
     "Y_Unit_Label\tmm\tN\tN\n"
     "***End_of_Header***\n"
     "X_Value\tPosition\tFriction Force\tNormal Force\tComment\n"
     "0.00\t0.000\t0.0028\t30.062\tstart\n"
     "0.05\t0.025\t6.2683\t30.049\tfast\n"
     "0.10\t0.050\t6.2848\t29.986\n"
     "0.15\t0.075\t6.3459\t30.007\t\n",
     {"Raw file/Header line = 6",
      "? Columns/Displacement = Position in mm",
      "? Columns/Tangential load = Friction Force in N",
      "? Columns/Normal load = Normal Force in N"},
     {"Raw file/Has header"}},
    {"english.csv",
     "Time (s),Displacement (mm),Normal Force (N),Friction Force (N),COF\n"
     "0,0,100,0,0\n0.1,0.01,100.2,5,0.05\n0.2,0.02,99.9,10,0.1\n",
     {"Raw file/Delimiter = comma",
      "Raw file/Header line = 1",
      "Columns/Time = Time (s) in s",
      "Columns/Displacement = Displacement (mm) in mm",
      "Columns/Normal load = Normal Force (N) in N",
      "Columns/Friction = COF",
      "? Constants/Area = 1 mm^2 assumed"},
     {"Convention/Friction sign", "Raw file/Units line"}},
    {"german_excel.csv",
     "\xEF\xBB\xBFZeit [s];Weg [mm];Normalkraft [N];Reibkraft [N]\r\n"
     "0,0;0,00;100,5;0,1\r\n0,1;0,01;100,4;5,2\r\n0,2;0,02;100,6;10,3\r\n",
     {"Raw file/Delimiter = semicolon",
      "Raw file/Decimal mark = comma",
      "Columns/Time = Zeit [s] in s",
      "Columns/Displacement = Weg [mm] in mm",
      "Columns/Normal load = Normalkraft [N] in N",
      "Columns/Tangential load = Reibkraft [N] in N"},
     {"Raw file/Thousands mark"}},
    {"units_line.txt",
     "Zeit\tWeg\tDruck\tReibwert\ns\tmm\tMPa\t-\n0\t0\t5.8\t0\n"
     "1\t0.1\t5.8\t0.1\n2\t0.2\t5.8\t0.11\n",
     {"Raw file/Delimiter = tab",
      "Raw file/Header line = 1",
      "Raw file/Units line = 2",
      "Columns/Time = Zeit in s",
      "Columns/Displacement = Weg in mm",
      "Columns/Pressure = Druck in MPa",
      "Columns/Friction = Reibwert"},
     {"Constants/Area"}},
    {"brackets_below.txt",
     "Pruefbericht 12\nPruefer: N. N.\n\nZeit;Traverse Weg;Kraft\n[s];[mm];[N]\n"
     "0,00;0,000;0,12\n0,02;0,001;1,43\n0,04;0,002;2,51\n",
     {"Raw file/Header line = 4",
      "Raw file/Units line = 5",
      "Columns/Displacement = Traverse Weg in mm",
      "Columns/Tangential load = Kraft in N",
      "? Constants/Normal load = 5 N assumed",
      "? Constants/Area = 1 mm^2 assumed"},
     {}},
    {"thousands.csv",
     "t in s;s in um;Ft in N;Fn in N\n0,0;0,0;0,0;1.500,0\n"
     "0,5;1.000,5;150,0;1.500,0\n1,0;2.001,0;160,0;1.500,0\n",
     {"Raw file/Decimal mark = comma",
      "Raw file/Thousands mark = point",
      "Columns/Time = t in s in s",
      "Columns/Displacement = s in um in um",
      "Columns/Tangential load = Ft in N in N"},
     {}},
    {"doubtful.txt",
     "t [s]\tx [um]\tmu\tp [MPa]\n0\t1,000\t0\t5\n1\t2,000\t0\t5\n"
     "2\t3,000\t0\t5\n",
     {"Raw file/Decimal mark = comma", "Columns/Friction = mu"},
     {}},
    {"old_mac.txt",
     "time_s,displacement_um,pressure_MPa,mu\r0,0,1,0\r1,1,1,0.1\r2,2,1,0.1\r",
     {"Columns/Time = time_s in s",
      "Columns/Displacement = displacement_um in um",
      "Columns/Pressure = pressure_MPa in MPa",
      "Columns/Friction = mu"},
     {}},
    {"no_header.dat",
     "0 0.0 0.00 100\n1 0.1 0.05 100\n2 0.2 0.06 100\n",
     {"Raw file/Delimiter = blanks",
      "Raw file/Has header = false",
      "Raw file/Header line = 1",
      "? Columns/Time = column 1 in s",
      "? Columns/Friction = column 2",
      "? Constants/Speed = 1 mm/s",
      "? Constants/Pressure = 5 MPa"},
     {}},
    {"blank_names.dat",
     "Time (s)  Position (mm)  Friction coefficient\n"
     "0.0  0.0  0.00\n1.0  0.1  0.05\n2.0  0.2  0.06\n",
     {"Raw file/Has header = false", "Raw file/Header line = 2"},
     {}},
    {"hash_header.txt",
     "# rig 3\n# t[s] x[mm] mu[-] sigma_n[MPa]\n0 0 0 5\n1 1 0.1 5\n2 2 0.1 5\n",
     {"Raw file/Header line = 2",
      "Columns/Time = t[s] in s",
      "Columns/Friction = mu[-]",
      "Columns/Pressure = sigma_n[MPa] in MPa"},
     {}},
    {"not_ascii.csv",
     "t [s];Vitesse (\xC2\xB5m/s);Normal stress (kgf/cm\xC2\xB2);mu;T \xC2\xB0"
     "F;Druck [N/mm\xB2]\n0;1;20;0.1;99;2\n1;1;20;0.1;99;2\n"
     "2;1;20;0.1;99;2\n",
     {"Columns/Speed = column 2 in um/s",
      "Columns/Pressure = column 3 in kgf/cm^2",
      "Columns/Temperature = column 5 in degF"},
     {}},
    // Names of several words, with their units below.
    {"two_lines.dat",
     "  Elapsed Time   Crosshead Pos.   Friction Force    Normal Force\n"
     "           (s)             (in)            (lbf)           (lbf)\n"
     "         0.000         0.000000          0.01698        67.36013\n"
     "         0.050         0.000787          9.42382        67.50979\n"
     "         0.100         0.001575         14.12786        67.35305\n",
     {"Columns/Time = column 1 in s",
      "Columns/Displacement = column 2 in in",
      "Columns/Tangential load = column 3 in lbf",
      "Columns/Normal load = column 4 in lbf"},
     {}},
    {"strip.csv",
     "Time s,Crosshead mm,Pull force kN,Clamp force 1 kN,Clamp force 2 kN\n"
     "0,0,0,1.50,1.5\n1,1,.6,1.51,1.51\n2,2,.6,1.5,1.5\n",
     {"? Columns/Normal load = Clamp force 1 kN in kN"},
     {}},
    {"japanese.csv",
     "時間[s],変位[mm],摩擦力[N],垂直荷重[N]\n"
     "0,0,0,300\n1,1,42,300\n2,2,42,301\n",
     {"Columns/Time = column 1 in s",
      "Columns/Displacement = column 2 in mm",
      "Columns/Tangential load = column 3 in N",
      "Columns/Normal load = column 4 in N"},
     {}},
    {"reversed.txt",
     "Time [s]\tNormal [uN]\tPosition [mm]\tFriction [uN]\n"
     "0\t5e6\t0\t-1e6\n1\t5e6\t1\t-2e6\n2\t5e6\t2\t-2e6\n3\t5e6\t1\t2e6\n",
     {"Columns/Normal load = Normal [uN] in uN",
      "Columns/Tangential load = Friction [uN] in uN",
      "Convention/Friction sign = reversed"},
     {}},
    {"compression_negative.txt",
     "t [s];x [mm];Fz [kN];Fx [kN]\n0;0;-5;0\n1;1;-5;0.5\n2;2;-5;0.6\n",
     {"Columns/Normal load = -1*{Fz [kN] in kN}",
      "Columns/Tangential load = Fx [kN] in kN"},
     {}},
    {"stresses.csv",
     "time [s],slip [um],shear stress [MPa],normal stress [MPa]\n"
     "0,0,0,30\n1,10,13,30\n2,20,15,30\n",
     {"Columns/Pressure = normal stress [MPa] in MPa",
      "Columns/Friction = {shear stress [MPa] in MPa}/{normal stress [MPa] in "
      "MPa}"},
     {"Constants/Area"}},
    {"clock.txt",
     "Uhrzeit;Pruefzeit [s];Weg [m];Last [N];Reibungszahl;Temperatur [\xC2\xB0"
     "C]\n10:00:01;1,0;0,1;60;0,10;25,1\n10:00:02;2,0;0,2;60;0,11;25,2\n"
     "10:00:03;3,0;0,3;60;0,12;25,3\nTest completed at 10:00\n",
     {"Columns/Time = Pruefzeit [s] in s",
      "Columns/Displacement = Weg [m] in m",
      "Columns/Normal load = Last [N] in N",
      "Columns/Friction = Reibungszahl",
      "Columns/Temperature = column 6 in degC",
      "Raw file/Comment marks = Test completed at"},
     {}},
    {"gaps.csv",
     "t [s];x [mm];p [bar];mu;Bemerkung\n0;0;58;0;\n1;;58;0,1;Start\n"
     "2;2;58;NaN;\n3;3;58;0,1;\n4;4;58;0,1;\n",
     {"Columns/Pressure = p [bar] in bar", "Columns/Friction = mu"},
     {}},
    {"no_units.csv",
     "Time,Distance,Load,Friction\n0,0,60,0\n1,150,60,0.1\n2,300,60,0.1\n",
     {"? Columns/Time = Time in s",
      "? Columns/Displacement = Distance in mm",
      "? Columns/Normal load = Load in N",
      "Columns/Friction = Friction"},
     {}},
    {"strange_unit.csv",
     "Time [s],Position [counts],Pressure [psi],Friction []\n"
     "0,0,800,0\n1,150,800,0.1\n2,300,800,0.1\n",
     {"Columns/Time = Time [s] in s", "Columns/Friction = Friction []"},
     {}},
    {"two_alike.txt",
     "\tTest Time\tStep Time\tRadius\tDistance\tFriction Force\tFriction "
     "Coefficient\tFriction Force\t\n"
     "\t6,\t3600,\t22\t0,000\t0,0\t0,00\t0,0\t\n"
     "\t7,\t3600,\t22\t0,150\t0,1\t0,10\t0,1\t\n"
     "\t8,\t3600,\t22\t0,300\t0,1\t0,11\t0,1\t\n",
     {"? Columns/Time = Test Time in s",
      "? Columns/Displacement = Distance in mm",
      "Columns/Friction = Friction Coefficient"},
     {}},
    {"swiss.csv",
     "t [s];x [um];mu;p [MPa]\n0;0;0;5\n1;1'000.5;0.1;5\n2;2'000.5;0.1;5\n",
     {"Raw file/Decimal mark = point",
      "Raw file/Thousands mark = apostrophe",
      "Columns/Displacement = x [um] in um"},
     {}},
    {"quoted.csv",
     "\"Time, s\",\"Displacement, mm\",\"COF\",\"Pressure, MPa\"\n"
     "\"0\",\"0\",\"0\",\"5\"\n\"1\",\"1\",\"0.1\",\"5\"\n"
     "\"2\",\"2\",\"0.1\",\"5\"\n",
     {"Raw file/Delimiter = comma",
      "Columns/Time = Time, s in s",
      "Columns/Displacement = Displacement, mm in mm",
      "Columns/Friction = COF"},
     {}},
    {"latin_1.csv",
     "Zeit [s];Weg [\xB5m];Reibungszahl \xB5;p [N/mm\xB2]\n0;0;0;5\n"
     "1;1;0,1;5\n2;2;0,1;5\n",
     {"Columns/Displacement = column 2 in um",
      "Columns/Friction = column 3",
      "Columns/Pressure = column 4 in N/mm^2"},
     {}},
    {"shear.csv", // compression counts negative
     "t [s],d [mm],sigma_n [MPa],tau [MPa]\n"
     "0,0,-5,0\n1,1,-5,0.5\n2,2,-5,0.5\n",
     {"Columns/Pressure = -1*{sigma_n [MPa] in MPa}",
      "Columns/Friction = {tau [MPa] in MPa}/(-1*{sigma_n [MPa] in MPa})"},
     {"Constants/Area"}},
    {"shear_without_unit.csv",
     "t [s],d [mm],sigma_n,tau [MPa]\n"
     "0,0,5,0\n1,1,5,0.5\n2,2,5,0.5\n",
     {"? Columns/Pressure = sigma_n in MPa",
      "? Columns/Friction = {tau [MPa] in MPa}/{sigma_n in MPa}"},
     {}},
    {"load_and_pressure.csv",
     "t [s],d [mm],normal load [N],pressure [MPa],friction force [N]\n"
     "0,0,60,5,0\n1,1,60,5,6\n2,2,60,5,6\n",
     {"Columns/Normal load = normal load [N] in N",
      "Columns/Pressure = pressure [MPa] in MPa",
      "Columns/Tangential load = friction force [N] in N"},
     {"Constants/Area"}},
    {"force_or_coefficient.csv",
     "t [s];x [mm];F\n0;0;0.2\n1;1;0.2\n2;2;0.2\n",
     {"? Columns/Friction = F"},
     {}},
    {"run #2*.csv",
     "t [s],d [mm],mu,p [MPa]\n0,0,0,5\n1,1,0.1,5\n2,2,0.1,5\n",
     {"Raw file/Name = run ?2?.csv"},
     {}},
    {"percent.csv",
     "t [s],d [mm],Fn [N],COF [%]\n0,0,10,0\n1,1,10,20\n2,2,10,20\n",
     {"Columns/Friction = COF [%]"},
     {}},
    // Three digits behind every mark, and whole numbers beside them.
    {"german_thousands.csv",
     "Zeit [s];Weg [um];Reibkraft [mN];Normalkraft [mN]\n"
     "0;0;29.028;581.250\n1;500;58.314;579.770\n2;1.000;58.618;578.089\n"
     "3;1.500;57.766;579.196\n",
     {"? Raw file/Thousands mark = point"},
     {"Raw file/Decimal mark"}},
    {"two_marks.csv",
     "Zeit [s];Weg [mm];Reibkraft [mN];Normalkraft [mN]\n"
     "1;1;120.000;1.000.000\n2;2;121.000;1.001.000\n3;3;121.500;1.002.000\n",
     {"Raw file/Thousands mark = point"},
     {"Raw file/Decimal mark"}},
    {"three_digits.csv",
     "t [s],d [mm],Fx [N],Fz [N]\n"
     "0.000,0.000,10.125,100.250\n0.500,1.500,10.250,100.125\n"
     "1.000,3.000,10.375,100.375\n",
     {"Raw file/Decimal mark = point"},
     {"Raw file/Thousands mark"}},
    // A way that only grows beside the position.
    {"distance_and_position.csv",
     "t [s],Sliding distance [mm],Position [mm],Fx [N],Fz [N]\n"
     "0,0,0,10,100\n1,1,1,10,100\n2,2,2,10,100\n3,3,1,-10,100\n"
     "4,4,0,-10,100\n5,5,1,10,100\n",
     {"Columns/Displacement = Position [mm] in mm"},
     {"Convention/Friction sign"}},
    // Whole numbers without a mark where thousands would have one.
    {"no_thousands.csv",
     "t [s],d [um],Fx [N],Fz [N]\n"
     "0,1500,10.125,100.250\n1,2.125,10.250,100.125\n"
     "2,3.250,10.375,100.375\n",
     {"Raw file/Decimal mark = point"},
     {"Raw file/Thousands mark"}},
    // Friction that has lost its sign says nothing of the motion.
    {"magnitudes.csv",
     "t [s],Position [mm],Distance [mm],COF,p [MPa]\n0,0,0,0.1,5\n"
     "1,1,1,0.1,5\n2,2,2,0.1,5\n3,1,3,0.1,5\n4,0,4,0.1,5\n5,1,5,0.1,5\n",
     {"Columns/Displacement = Position [mm] in mm",
      "Convention/Friction sign = of the motion"},
     {}},
    {"set_and_actual.csv",
     "t [s],Position set [mm],Position act [mm],p [MPa],mu\n"
     "0,0,0,5,0\n1,1,0.9,5,0.1\n2,2,1.9,5,0.1\n",
     {"Columns/Displacement = Position act [mm] in mm"},
     {}},
    // Uncommented, a unit that nobody knows is refused.
    {"furlongs.csv",
     "Time [MIN],x [furlong],N [KN],Ft [kips]\n0,0,5,0\n1,1,5,0.1\n"
     "2,2,5,0.1\n",
     {"? Columns/Displacement = x [furlong] in ?",
      "Columns/Tangential load = Ft [kips] in kips",
      "Columns/Normal load = N [KN] in KN"},
     {"Convention/Friction sign"}},
    {"clock_that_begins_anew.csv",
     "Cycle,Time [s],x [mm],Ft [N],Fz [N]\n1,0,0,0,9\n1,1,1,1,9\n"
     "2,0,2,1,9\n2,1,3,1,9\n",
     {"? Columns/Time = Time [s] in s"},
     {}},
    {"clamped.csv",
     "t [s],x [mm],Load (N),Clamp force (kN)\n0,0,0,1\n1,1,99,1.1\n",
     {"Columns/Normal load = Clamp force (kN) in kN",
      "? Test/Condition = dry, 1.1 kN"},
     {}},
    {"forces_set_and_actual.csv",
     "t [s],x [mm],Fx_meas [N],Fz set [kN],Fz act [kN]\n"
     "0,0,0,1,1.01\n1,1,100,1,0.99\n2,2,101,1,1.01\n",
     {"Columns/Tangential load = Fx_meas [N] in N",
      "Columns/Normal load = Fz act [kN] in kN"},
     {}},
    // A date has points, but no thousands.
    {"dates.csv",
     "Datum;Zeit (s);Weg (mm);F_N (N);F_R (N)\n24.12.2025;0;0;100;20,5\n"
     "24.12.2025;0,5;1;100;20,25\n24.12.2025;1;2;100;20,125\n",
     {"Raw file/Decimal mark = comma", "Columns/Time = Zeit (s) in s"},
     {"Raw file/Thousands mark"}},
    // Of double precision, as Fortran writes them.
    {"fortran.csv",
     "t [s],x [mm],Ft [N],Fz [N]\n0.D0,0.0D+00,1.0D+01,1.0D+02\n"
     "1.0D-01,2.0D-02,1.0D+01,1.0D+02\n2.0D-01,4.0D-02,1.0D+01,1.0D+02\n",
     {"Columns/Time = t [s] in s", "Columns/Displacement = x [mm] in mm"},
     {}},
    // Of two axes that which moves, with its friction.
    {"preload.csv",
     "t [s],x [mm],Preload [N],Load [N],Friction force [N]\n"
     "0,0,100,250,1\n1,1,100,250,2\n2,2,100,250,2\n",
     {"? Columns/Normal load = Preload [N] in N",
      "Columns/Tangential load = Friction force [N] in N"},
     {}},
    {"second_axis.txt",
     "T [s]\tFx [N]\tFy [N]\tFz [N]\tX [mm]\tY [um]\n"
     "0\t0.01\t2\t9\t0\t0\n1\t0.02\t2\t9\t0.01\t5000\n"
     "2\t-0.01\t2\t9\t0.02\t9000\n",
     {"Columns/Displacement = Y [um] in um",
      "Columns/Tangential load = Fy [N] in N",
      "Columns/Normal load = Fz [N] in N"},
     {}},
    {"no_friction_along_it.txt",
     "T [s]\tFy [N]\tFz [N]\tX [mm]\n0\t1\t9\t0\n1\t2\t9\t1\n2\t2\t9\t2\n",
     {"? Columns/Displacement = X [mm] in mm",
      "? Columns/Tangential load = Fy [N] in N"},
     {}},
    {"both_axes.txt",
     "T [s]\tForce x [N]\tForce y [N]\tForce z [N]\tPosition X [mm]\t"
     "Position Y [mm]\tPosition Z [mm]\n"
     "0\t1\t2\t9\t0\t0\t0\n1\t1\t2\t9\t1\t1\t5\n2\t1\t2\t9\t2\t2\t9\n",
     {"Columns/Displacement = Position X [mm] in mm",
      "Columns/Displacement y = Position Y [mm] in mm",
      "Columns/Tangential load = Force x [N] in N",
      "Columns/Tangential load y = Force y [N] in N",
      "Columns/Normal load = Force z [N] in N"},
     {}},
    // A length is not yet a way that was slid.
    {"depth.txt",
     "Time [s],COF,Penetration depth [um],Eindringweg [um],Gap [mm],"
     "LVDT [mm],Position Z [mm],p [MPa]\n"
     "0,0,3,3,1,2,0,5\n1,0.1,4,4,2,3,1,5\n2,0.1,5,5,3,4,2,5\n",
     {"? Constants/Speed = 1 mm/s"},
     {"Columns/Displacement"}},
    {"lengths.txt",
     "Time [s],COF,Gap [mm],Crosshead [mm],p [MPa]\n"
     "0,0,3,3,5\n1,0.1,4,4,5\n2,0.1,5,5,5\n",
     {"Columns/Displacement = Crosshead [mm] in mm"},
     {}},
    {"extension.txt",
     "Time [s],COF,Extension [mm],p [MPa]\n"
     "0,0,3,5\n1,0.1,4,5\n2,0.1,5,5\n",
     {"Columns/Displacement = Extension [mm] in mm"},
     {}},
    // A spreadsheet's dates; but not where a unit says otherwise, and not a
    // clock that began long ago.
    {"serial_day.csv",
     "Zeit,x [mm],mu,p [MPa]\n45000.00000,0,0,5\n45000.00001,1,0.1,5\n"
     "45000.00002,2,0.1,5\n",
     {"? Columns/Time = Zeit in d"},
     {}},
    {"serial_date.csv",
     "Datum,x [mm],mu,p [MPa]\n45000.5,0,0,5\n45000.5000116,1,0.1,5\n"
     "45000.5000231,2,0.1,5\n",
     {"? Columns/Time = Datum in d"},
     {}},
    {"long_since.csv",
     "Time,x [mm],mu,p [MPa]\n45000.00,0,0,5\n45000.01,1,0.1,5\n"
     "45000.02,2,0.1,5\n",
     {"? Columns/Time = Time in s"},
     {}},
    {"fast_clock.csv",
     "Time [s],x [mm],mu,p [MPa]\n45000.00000,0,0,5\n45000.00001,1,0.1,5\n"
     "45000.00002,2,0.1,5\n",
     {"Columns/Time = Time [s] in s"},
     {}},
    // Footers in quotes, as all cells.
    {"quoted_footers.csv",
     "\"t [s]\",\"x [mm]\",\"mu\",\"p [MPa]\"\n" +
       []() {
         std::string rows;
         for (int i = 0; i < 30; ++i)
           rows += "\"" + std::to_string(i) + "\",\"" + std::to_string(i) +
                   "\",\"0.1\",\"5\"\n";
         return rows;
       }() +
       "\n\"Maximum\",\"29\",\"0.1\"\n\"Standard deviation\",\"9\",\"0\"\n",
     {"Raw file/Comment marks = Maximum, Standard deviation",
      "Columns/Time = t [s] in s"},
     {}},
    {"command.csv",
     "Time [Sec],Pos. cmd [mm],Pos. act [mm],Fric [N],Norm [N]\n"
     "0,0,0,0,9\n1,1,1,2,9\n2,2,2,2,9\n",
     {"Columns/Time = Time [Sec] in Sec",
      "Columns/Displacement = Pos. act [mm] in mm",
      "Columns/Tangential load = Fric [N] in N",
      "Columns/Normal load = Norm [N] in N"},
     {}},
    {"masses.csv",
     "Time [s],x [mm],mu,Load [kg]\n0,0,0,1\n1,1,0.1,1\n2,2,0.1,1\n",
     {"? Columns/Normal load = Load [kg] in kgf"},
     {}},
    {"french.csv",
     "Temps;D\xC3\xA9placement [mm];Charge [N];Force de frottement [N]\n"
     "0;0;9;0\n1;1;9;2\n2;2;9;2\n",
     {"? Columns/Time = Temps in s",
      "Columns/Displacement = column 2 in mm",
      "Columns/Normal load = Charge [N] in N",
      "Columns/Tangential load = Force de frottement [N] in N"},
     {"Columns/Temperature"}},
    {"french_1.csv",
     "Temps [s];D\xE9placement [mm];Force normale [N];Effort tangentiel [N]\n"
     "0;0;9;0\n1;1;9;2\n2;2;9;2\n",
     {"Columns/Time = Temps [s] in s",
      "Columns/Displacement = column 2 in mm",
      "Columns/Normal load = Force normale [N] in N",
      "Columns/Tangential load = Effort tangentiel [N] in N"},
     {}},
    {"nameless.csv",
     "t [s],d [mm],p [MPa],signal\n0,0,10,0\n1,1,10,20\n2,2,10,20\n",
     {"? Columns/Friction = column 4"},
     {}}};
} // namespace SlipStep::Testing

#endif
