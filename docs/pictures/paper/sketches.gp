# SPDX-License-Identifier: BSD-3-Clause
# Copyright 2026 the Yoke authors
#
# Sketches of the arrangements in Figures 1, 4, 8 and 9 of Machines 2022, 10, 966, drawn by us.
# Run in this folder: gnuplot sketches.gp
set encoding utf8
unset border; unset tics; unset key; set parametric; set samples 200
dark = "#303030"; blue = "#0072b2"; red = "#d55e00"; grey = "#d9d9d9"

# ---- Figure 1: the impact pair of Dubowsky and Freudenstein
set terminal pngcairo size 900,440 font "DejaVu Sans,13" background rgb "white"
set output "figure1.png"
set size ratio -1; set xrange [-6:6]; set yrange [-3.4:2.2]
set object 1 rectangle from -2.2,-1.0 to 2.2,1.6 fc rgb grey fs solid border rgb dark lw 2
set object 2 rectangle from -1.6,-0.4 to 1.6,1.0 fc rgb "white" fs solid border rgb dark lw 2
set object 3 rectangle from -0.7,-0.2 to 0.7,0.8 fc rgb blue fs solid 0.25 border rgb blue lw 2
set label 1 "M_1" at 0,0.3 center tc rgb blue
set label 2 "M_2" at 0,1.3 center
set arrow 1 from 0.7,0.3 to 1.6,0.3 heads size 0.12,20 lc rgb red lw 1.5
set label 3 "r" at 1.15,0.55 center tc rgb red
set arrow 2 from -1.6,0.3 to -0.7,0.3 heads size 0.12,20 lc rgb red lw 1.5
set label 4 "r" at -1.15,0.55 center tc rgb red
set arrow 3 from -4.4,0.3 to -2.9,0.3 lw 2 lc rgb blue
set label 5 "F_1(t), on M_1" at -3.65,0.75 center tc rgb blue
set arrow 4 from 2.4,0.3 to 3.9,0.3 lw 2 lc rgb dark
set label 6 "F_2(t), on M_2" at 4.0,0.75 center
set arrow 5 from 0,-0.2 to 0,-1.75 nohead dt 3 lc rgb blue
set arrow 6 from 0,-1.75 to 0,-2.3 nohead dt 3 lc rgb dark
set arrow 7 from -5.2,-1.6 to 0,-1.6 lc rgb blue lw 1.5
set label 7 "X_1" at -3.6,-1.3 center tc rgb blue
set arrow 8 from -5.2,-2.15 to 0,-2.15 lc rgb dark lw 1.5
set label 8 "X_2" at -3.6,-1.9 center
set arrow 9 from -5.2,-2.4 to -5.2,-1.2 nohead lw 2 lc rgb dark
set label 9 "X_r = X_1 - X_2: apart while |X_r| < r, beyond the surfaces press with g(X_r)" at 0,-2.9 center
set label 10 "(to the middle of the gap)" at 0.3,-2.15 left
set title "Impact pair of Dubowsky and Freudenstein"
plot 10,10 notitle
unset object; unset arrow; unset label

# ---- Figure 4: central collision
set terminal pngcairo size 1000,430 font "DejaVu Sans,13" background rgb "white"
set output "figure4.png"
set title "Central collision: approach, compression, restitution, separation"
set xrange [-0.6:20.6]; set yrange [-3:2.8]
R = 1.1
do for [k=0:3] {
  c = 2.5 + 5.0*k
  g = (k==0) ? 1.5 : (k==1) ? 0.95 : (k==2) ? 1.03 : 1.5
  set object 10+2*k circle at c-g,0 size R fc rgb blue fs transparent solid 0.25 border rgb blue lw 2
  set object 11+2*k circle at c+g,0 size R*0.98 fc rgb red fs transparent solid 0.25 border rgb red lw 2
  set label 10+4*k "i" at c-g,0 center tc rgb blue
  set label 11+4*k "j" at c+g,0 center tc rgb red
}
set arrow 1 from 0.4,1.6 to 1.9,1.6 lw 2 lc rgb blue; set label 1 "u_i" at 1.1,2.0 center tc rgb blue
set arrow 2 from 3.4,1.6 to 4.2,1.6 lw 2 lc rgb red; set label 2 "u_j" at 3.8,2.0 center tc rgb red
set arrow 3 from 6.2,1.6 to 7.2,1.6 lw 2 lc rgb blue; set arrow 4 from 7.9,1.6 to 8.9,1.6 lw 2 lc rgb red
set arrow 5 from 11.2,1.6 to 12.0,1.6 lw 2 lc rgb blue; set arrow 6 from 12.9,1.6 to 14.1,1.6 lw 2 lc rgb red
set arrow 7 from 15.7,1.6 to 16.3,1.6 lw 2 lc rgb blue; set label 3 "ũ_i" at 16.0,2.0 center tc rgb blue
set arrow 8 from 18.2,1.6 to 19.7,1.6 lw 2 lc rgb red; set label 4 "ũ_j" at 18.9,2.0 center tc rgb red
set label 5 "before:\nd < 0" at 2.5,-1.6 center
set label 6 "compression:\nd > 0, d' > 0" at 7.5,-1.6 center
set label 7 "restitution:\nd > 0, d' < 0" at 12.5,-1.6 center
set label 8 "after:\nd < 0" at 17.5,-1.6 center
plot 30,30 notitle
unset object; unset arrow; unset label

# ---- Figures 8 and 9: the scotch-yoke. [mm]; crank of 45 mm
Rm = 60.0; h = 8.0; rp = 7.9; crank = 45.0; th = 60*pi/180
ex(s) = Rm*cos(th); ey = Rm*sin(th)
arcx(R,t) = R*cos(t); arcy(R,t) = R*sin(t)
set terminal pngcairo size 900,560 font "DejaVu Sans,13" background rgb "white"
set output "figure8.png"
set title "Scotch-yoke with a circular slot"
phi = 40*pi/180
px = crank*cos(phi); py = crank*sin(phi)
X = px - sqrt(Rm**2 - py**2)    # centre of the arc
set xrange [-85:130]; set yrange [-92:84]
set trange [-1:1]
set object 1 rectangle from X+14,-72 to X+82,72 fc rgb grey fs solid border rgb dark lw 1.5 behind
set object 2 rectangle from X+82,-5 to X+125,5 fc rgb grey fs solid border rgb dark lw 1.5 behind
set object 5 rectangle from X-45,-5 to X+14,5 fc rgb grey fs solid border rgb dark lw 1.5 behind
set object 6 rectangle from X+110,-9 to X+128,9 fc rgb "#a0a0a0" fs solid border rgb dark lw 1.5
set object 7 rectangle from X-55,-9 to X-37,9 fc rgb "#a0a0a0" fs solid border rgb dark lw 1.5
set object 3 circle at px,py size rp fc rgb blue fs solid 0.5 border rgb blue lw 2 front
set object 4 circle at 0,0 size 4 fc rgb "white" fs solid border rgb dark lw 2 front
set arrow 1 from 0,0 to px,py nohead lw 7 lc rgb blue front
set arrow 2 from X+60,-80 to X+90,-80 lw 2 lc rgb dark
set label 1 "X" at X+97,-80 center front
set label 2 "crank, ω" at -9,14 right tc rgb blue front
set label 3 "pin" at px+2,py+14 center tc rgb blue front
set label 4 "slotted slider" at X+48,77 center front
set label 5 "mass m" at X+119,15 center front
set label 6 "mass m" at X-46,15 center front
set arrow 3 from -80,0 to 125,0 nohead dt 3 lc rgb dark back
set arrow 4 from 18,0 to 18*cos(phi*0.55),18*sin(phi*0.55) nohead lc rgb blue front
set label 7 "Θ" at 24,8 center tc rgb blue front
set style fill solid
plot X+arcx(Rm+h,th*t), arcy(Rm+h,th*t) w l lw 2 lc rgb red, \
     X+arcx(Rm-h,th*t), arcy(Rm-h,th*t) w l lw 2 lc rgb red, \
     X+arcx(Rm,th)+h*cos(th+pi*(t+1)/2), arcy(Rm,th)+h*sin(th+pi*(t+1)/2) w l lw 2 lc rgb red, \
     X+arcx(Rm,-th)+h*cos(-th-pi*(t+1)/2), arcy(Rm,-th)+h*sin(-th-pi*(t+1)/2) w l lw 2 lc rgb red, \
     X+arcx(Rm,th*t), arcy(Rm,th*t) w l lw 1 dt 3 lc rgb red
unset object; unset arrow; unset label

set terminal pngcairo size 1100,560 font "DejaVu Sans,13" background rgb "white"
set output "figure9.png"
set multiplot layout 1,2 title "Pin in the slot: without clearance, with clearance (drawn too large)"
do for [side=0:1] {
  cl = side ? 5.0 : 0.0       # clearance, far too large
  rp = 8.0; hh = rp + cl/2
  set title side ? "R_o = R_i + 2 R_p + clearance" : "R_o = R_i + 2 R_p"
  set xrange [-8:88]; set yrange [-46:36]
  Ri = Rm - hh; Ro = Rm + hh
  p = Rm - (side ? cl/2 : 0)
  set object 1 circle at p,0 size rp fc rgb blue fs solid 0.3 border rgb blue lw 2
  set object 2 circle at 0,0 size 0.8 fc rgb dark fs solid
  set arrow 1 from 0,0 to Ri*cos(0.42),Ri*sin(0.42) lw 1.5 lc rgb dark
  set label 1 "R_i" at 0.6*Ri*cos(0.42)-2,0.6*Ri*sin(0.42)+3 center
  set arrow 2 from 0,0 to Ro*cos(-0.42),Ro*sin(-0.42) lw 1.5 lc rgb dark
  set label 2 "R_o" at 0.6*Ro*cos(-0.42)-2,0.6*Ro*sin(-0.42)-4 center
  set arrow 3 from p,0 to p,rp lw 1.5 lc rgb blue
  set label 3 "R_p" at p-3.5,3.5 center tc rgb blue
  if (side) { set arrow 4 from p+rp,0 to Ro,0 heads size 1.2,20 lw 1.5 lc rgb red; set label 4 "clearance" at Ro+1.5,-4 left tc rgb red; set label 5 "ΔR outside = R_o - R_p" at 4,-37 left; set label 6 "ΔR inside = R_i + R_p = ΔR outside - clearance" at 4,-43 left } else { set label 5 "ΔR inside = R_i + R_p" at 4,-37 left; set label 6 "ΔR outside = R_o - R_p = the same" at 4,-43 left }
  plot Ri*cos(0.5*t), Ri*sin(0.5*t) w l lw 2 lc rgb red, Ro*cos(0.5*t), Ro*sin(0.5*t) w l lw 2 lc rgb red
  unset object; unset arrow; unset label
}
unset multiplot
