# BRDF and specular reflectance against wavelength.
#   title       text
#   $spectrum   wavelength [um], diffuse terms [1/sr], specular reflectance
reset
set datafile separator comma
set title title noenhanced font ',17'
set xlabel 'wavelength [µm]'
set ylabel 'BRDF [1/sr]'
set y2label 'specular reflectance'
set ytics nomirror
set y2tics
set yrange [0:*]
set y2range [0:*]
set grid lc rgb '#dddddd'
set bmargin at screen 0.18
set key at screen 0.5,0.02 bottom center horizontal
plot $spectrum using 1:2 with lines lw 2.5 lc rgb '#0072b2' title 'diffuse terms (left)', \
     '' using 1:3 axes x1y2 with lines lw 2.5 dt 2 lc rgb '#d55e00' title 'specular (right)'
