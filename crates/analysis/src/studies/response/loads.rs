//! The periodic loads of a machine: which of them follow the parameter and at what orders, and what each order brings at a frequency.

use super::faults::{no_load, not_proportional};
use super::{Component, Excitation, Forced, SAME, SILENT, Source, oscillates};
use crate::Fault;
use crate::linear::Matrices;
use crate::studies::modes::Complex;
use crate::waveform::LISTED;
use algebra::arrange::Arrange;
use algebra::elementary;

impl<'m> Forced<'m> {
    /// Rates of the loads per unit of the parameter, not numbers where they are not proportional to it, and its value; as they are without one.
    fn paces(&mut self, parameter: Option<usize>, own: &[f64]) -> Result<(Vec<f64>, f64), Fault> {
        Ok(match parameter {
            Some(parameter) => {
                let value = self.machine.value(parameter);
                let probe = if value == 0.0 { 1.0 } else { value };
                let mut seen = Vec::new();
                for k in [1.0, 2.0] {
                    self.machine.set(parameter, probe * k)?;
                    let matrices = self.machine.at(&self.place)?;
                    seen.push(self.excitation(&matrices)?.rates());
                }
                self.machine.set(parameter, value)?;
                // proportional, but for rounding
                let per = |(a, b): (&f64, &f64)| if a.abs() > 0.0 && (b - 2.0 * a).abs() <= 1e-12 * b.abs() { a / probe } else { f64::NAN };
                (seen[0].iter().zip(&seen[1]).map(per).collect::<Vec<f64>>(), value)
            }
            None => (own.to_vec(), 1.0),
        })
    }

    /// Orders of the loads that follow the parameter.
    pub(super) fn arrange(&mut self, parameter: Option<usize>) -> Result<(), Fault> {
        let matrices = self.machine.at(&self.place)?;
        let excitation = self.excitation(&matrices)?;
        if excitation.waves.iter().all(|w| w.0.is_none()) && excitation.shaped.is_empty() {
            if let Some(p) = parameter {
                // a load of any frequency follows the parameter itself
                let own = &self.machine.parameters()[p];
                if own.unit != "rad/s" {
                    return Err(not_proportional(&own.name));
                }
                self.follows = Some((p, 1.0_f64.copysign(self.machine.value(p))));
            }
            self.components = vec![Component { order: 1.0, waves: (0..excitation.waves.len()).collect(), harmonics: Vec::new() }];
            return Ok(());
        }
        let own = excitation.rates();
        let (per, value) = self.paces(parameter, &own)?;
        let mut following: Vec<f64> = per.iter().map(|r| r.abs()).filter(|r| *r > 0.0).collect();
        following.sort_by(f64::total_cmp);
        following.dedup_by(|a, b| (*a - *b).abs() <= SAME * b.abs());
        // what stands still belongs to the place of rest
        let moves = |i: usize| excitation.waves.get(i).is_none_or(|w| w.1.iter().any(|z| *z != (0.0, 0.0)));
        self.left_out = own
            .iter()
            .zip(&per)
            .enumerate()
            .filter(|(i, (w, p))| p.is_nan() && **w != 0.0 && moves(*i))
            .map(|(_, (w, _))| w.abs())
            .collect();
        let angular = parameter.is_some_and(|p| self.machine.parameters()[p].unit == "rad/s");
        let axis = match (&following[..], parameter) {
            ([], Some(p)) => return Err(not_proportional(&self.machine.parameters()[p].name)),
            ([], None) => return Err(no_load()),
            ([only], _) => *only,
            // several orders of a speed are counted from the speed itself
            ([least, ..], _) => {
                if angular {
                    1.0
                } else {
                    *least
                }
            }
        };
        // a negative frequency of the file stays one: amplitudes may be formulas of it
        self.follows = parameter.map(|p| (p, axis.recip().copysign(if value < 0.0 { -1.0 } else { 1.0 })));
        self.own = Some(axis * value.abs());
        let loads = excitation.waves.len();
        for (i, rate) in per.iter().enumerate().filter(|(_, r)| r.abs() > 0.0) {
            let order = rate.abs() / axis;
            if i < loads {
                self.component(order).waves.push(i);
                continue;
            }
            let (form, ..) = excitation.shaped[i - loads];
            let wave = self.machine.shapes()[form].wave.clone();
            let largest = wave.cos.iter().chain(&wave.sin).fold(0.0_f64, |m, v| m.max(v.abs()));
            for k in 1..=LISTED {
                if elementary::hypot(wave.cos[k - 1], wave.sin[k - 1]) > SILENT * largest {
                    self.component(order * k as f64).harmonics.push((i - loads, k));
                }
            }
        }
        self.components.arrange_by(|a, b| a.order.total_cmp(&b.order));
        self.current = self.components.iter().position(|c| (c.order - 1.0).abs() <= SAME).unwrap_or(0);
        if self.components.is_empty() { Err(no_load()) } else { Ok(()) }
    }

    pub(super) fn component(&mut self, order: f64) -> &mut Component {
        let place = self.components.iter().position(|c| (c.order - order).abs() <= SAME * order).unwrap_or_else(|| {
            let order = if (order - order.round()).abs() <= SAME * order { order.round() } else { order };
            self.components.push(Component { order, ..Component::default() });
            self.components.len() - 1
        });
        &mut self.components[place]
    }

    /// The loads for the parameters as they are.
    pub(in crate::studies) fn excitation(&self, matrices: &Matrices) -> Result<Excitation, Fault> {
        let n = matrices.n;
        let complex = |rate: f64, cos: &[f64], sin: &[f64]| -> Vec<Complex> {
            let sign = if rate < 0.0 { -1.0 } else { 1.0 };
            cos.iter().zip(sin).map(|(c, s)| (*c, -sign * s)).collect()
        };
        let values = match &self.given {
            Some(given) => self.machine.values(given, &self.place)?,
            None => Vec::new(),
        };
        let rates = self.form_rates()?;
        Ok(match &self.source {
            Source::OfEquations if matrices.loads.is_empty() && matrices.shaped.is_empty() => self.borne(n)?,
            Source::OfEquations => Excitation {
                waves: matrices.loads.iter().map(|l| (Some(l.rate), complex(l.rate, &l.cos, &l.sin))).collect(),
                shaped: matrices.shaped.iter().map(|(form, f)| (*form, rates[*form], f.clone())).collect(),
            },
            Source::Given { waves, shaped, .. } => {
                let (first, rest) = values.split_at((2 * n + 1) * waves.len());
                let wave = |l: &[f64]| (Some(l[0]), complex(l[0], &l[1..=n], &l[n + 1..]));
                Excitation {
                    waves: first.chunks_exact(2 * n + 1).map(wave).collect(),
                    shaped: shaped.iter().zip(rest.chunks_exact(n)).map(|((form, _), f)| (*form, rates[*form], f.to_vec())).collect(),
                }
            }
            Source::Constant(..) => Excitation { waves: vec![(None, values.iter().map(|c| (*c, 0.0)).collect())], shaped: Vec::new() },
            Source::Unit(i) => {
                let unit = (0..n).map(|k| (f64::from(u8::from(k == *i)), 0.0)).collect();
                Excitation { waves: vec![(None, unit)], shaped: Vec::new() }
            }
        })
    }

    /// Loads that move nothing, as supports bear them alone: the rates at which outputs over the reactions oscillate by themselves.
    fn borne(&self, n: usize) -> Result<Excitation, Fault> {
        let mut waves: Vec<(Option<f64>, Vec<Complex>)> = Vec::new();
        for (rate, ..) in
            self.machine.observe(&self.observer, &self.place)?.iter().flat_map(|seen| &seen.waves).filter(|wave| oscillates(wave))
        {
            let known = |(other, _): &(Option<f64>, Vec<Complex>)| other.is_some_and(|w| (w.abs() - rate.abs()).abs() <= SAME * rate.abs());
            if !waves.iter().any(known) {
                waves.push((Some(*rate), vec![(0.0, 0.0); n]));
            }
        }
        Ok(Excitation { waves, shaped: Vec::new() })
    }

    /// Rates of the waveforms.
    pub(in crate::studies) fn form_rates(&self) -> Result<Vec<f64>, Fault> {
        self.machine.values(&self.rates, &self.place)
    }

    /// The loads at instants as the equations have them, less those that do not follow ω.
    pub(in crate::studies) fn forces(&self, excitation: &Excitation, times: &[f64]) -> Result<Vec<Vec<f64>>, Fault> {
        let mut list = self.machine.values_over_time(&self.whole, &self.place, times)?;
        let used = |i: usize| self.components.iter().any(|c| c.waves.contains(&i));
        for (rate, load) in excitation.waves.iter().enumerate().filter(|(i, _)| !used(*i)).map(|(_, w)| w) {
            for (row, t) in list.iter_mut().zip(times) {
                let (s, c) = elementary::sin_cos(rate.unwrap_or(0.0).abs() * t);
                row.iter_mut().zip(load).for_each(|(v, z)| *v -= z.0 * c - z.1 * s);
            }
        }
        let used = |i: usize| self.components.iter().any(|c| c.harmonics.iter().any(|h| h.0 == i));
        for (form, rate, factors) in excitation.shaped.iter().enumerate().filter(|(i, _)| !used(*i)).map(|(_, s)| s) {
            let values = self.machine.waveform(*form, &times.iter().map(|t| rate * t).collect::<Vec<_>>())?;
            for (row, w) in list.iter_mut().zip(values) {
                row.iter_mut().zip(factors).for_each(|(v, f)| *v -= f * w);
            }
        }
        Ok(list)
    }

    /// F = c - i s of an order.
    pub(in crate::studies) fn load(&self, excitation: &Excitation, component: usize, n: usize) -> Vec<Complex> {
        let Some(component) = self.components.get(component) else { return vec![(0.0, 0.0); n] };
        let mut sum = vec![(0.0, 0.0); n];
        for i in &component.waves {
            sum.iter_mut().zip(&excitation.waves[*i].1).for_each(|(s, z)| *s = (s.0 + z.0, s.1 + z.1));
        }
        for (i, k) in &component.harmonics {
            let (form, rate, factors) = &excitation.shaped[*i];
            let wave = &self.machine.shapes()[*form].wave;
            let (c, s) = (wave.cos[k - 1], -wave.sin[k - 1] * if *rate < 0.0 { -1.0 } else { 1.0 });
            sum.iter_mut().zip(factors).for_each(|(z, f)| *z = (z.0 + f * c, z.1 + f * s));
        }
        sum
    }
}
