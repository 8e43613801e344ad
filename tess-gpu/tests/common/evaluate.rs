//! Evaluates WGSL functions that are a single expression of integers, such as the accessors of
//! packed words.

use naga::{BinaryOperator as Op, Expression, Function, Handle, Literal, Module, Statement};

/// An argument of a call.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Argument {
    One(u32),
    Two([u32; 2]),
}

/// The value that the function `name` returns.
pub(crate) fn call(module: &Module, name: &str, arguments: &[Argument]) -> u32 {
    let mut functions = module.functions.iter().map(|(_, function)| function);
    let function = functions.find(|function| function.name.as_deref() == Some(name));
    let function = function.unwrap_or_else(|| panic!("no function {name}"));
    let result = function.body.iter().find_map(|statement| match statement {
        Statement::Return { value } => *value,
        _ => None,
    });
    value(function, arguments, result.unwrap_or_else(|| panic!("{name} returns something")))
}

fn value(function: &Function, arguments: &[Argument], at: Handle<Expression>) -> u32 {
    match &function.expressions[at] {
        Expression::Literal(Literal::U32(value)) => *value,
        Expression::FunctionArgument(number) => match arguments[*number as usize] {
            Argument::One(word) => word,
            Argument::Two(_) => panic!("a vector as a number"),
        },
        Expression::AccessIndex { base, index } => {
            match (&function.expressions[*base], *index as usize) {
                (Expression::FunctionArgument(number), index) => {
                    match arguments[*number as usize] {
                        Argument::Two(words) => words[index],
                        Argument::One(_) => panic!("a member of a number"),
                    }
                }
                (other, _) => panic!("a member of {other:?}"),
            }
        }
        Expression::Binary { op, left, right } => {
            let [left, right] = [left, right].map(|&side| value(function, arguments, side));
            match op {
                Op::And => left & right,
                Op::Multiply => left * right,
                Op::ShiftLeft => left << right,
                Op::ShiftRight => left >> right,
                other => panic!("the operator {other:?}"),
            }
        }
        other => panic!("{other:?} is not evaluated"),
    }
}
